// Manipulators as papers and books print them, typed into files that name their sources (published/*.toml,
// examples/gosselin_jean.toml): what is printed about them comes out, or what follows from it by formulas that the
// program does not use.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>

#include "reprise/base/constants.hpp"
#include "running.hpp"

using namespace reprise;
using nlohmann::json;
using reprise::test::Ended;
using reprise::test::run;

namespace {

std::string published(const std::string& name) {
  return (std::filesystem::path(REPRISE_SOURCE) / "tests/apps/published" / (name + ".toml")).string();
}

json document(std::vector<std::string> arguments) {
  arguments.emplace_back("--json");
  const Ended ended = run(arguments);
  BOOST_REQUIRE_MESSAGE(ended.code == 0, ended.err);
  return ended.document();
}

std::string text(double number) { return json(number).dump(); }

json assemble(const std::string& name, double l1, double l2, double l3) {
  const json found = document({"assemble", published(name), "--lengths", text(l1), text(l2), text(l3)});
  BOOST_TEST(!found["infinitely_many"].get<bool>());
  return found["modes"];
}

double orientation(const json& mode) { return mode["orientation_deg"].get<double>() * pi / 180.0; }

/// A leg's length squared, from complex numbers: base joint, platform joint, position and orientation.
double square(std::complex<double> base, std::complex<double> platform, std::complex<double> at, double turn) {
  return std::norm(at + platform * std::polar(1.0, turn) - base);
}

}  // namespace

// Activity 2: f vanishes at theta = -pi/4 and pi/4, the poses of Figure 1.15, with (x, y) = (1, 2) and (2, 1).
BOOST_AUTO_TEST_CASE(sauer_has_the_two_poses_of_the_book) {
  const double root = std::sqrt(5.0);
  const json modes = assemble("sauer_1", root, root, root);
  BOOST_REQUIRE_EQUAL(modes.size(), 2U);
  const auto check = [](const json& mode, double x, double y, double degrees) {
    BOOST_TEST(std::abs(mode["x"].get<double>() - x) < 1e-12);
    BOOST_TEST(std::abs(mode["y"].get<double>() - y) < 1e-12);
    BOOST_TEST(std::abs(mode["orientation_deg"].get<double>() - degrees) < 1e-11);
  };
  check(modes[0], 1.0, 2.0, -45.0);
  check(modes[1], 2.0, 1.0, 45.0);
}

// Activity 4 asks for four poses at p = (5, 5, 3), activity 5 for six at p2 = 7. The angles are those of published
// solutions, as at mason.gmu.edu/~kmclane/project_1_4.html, with (x, y) there.
BOOST_AUTO_TEST_CASE(sauer_has_the_four_and_the_six_poses_of_the_book) {
  const std::array<std::array<double, 3>, 4> printed{
      {{-0.7208, -1.3784, 4.8062}, {-0.3310, -0.9147, 4.9156}, {1.1437, 4.4817, 2.2167}, {2.1159, 4.5718, 2.0244}}};
  const json four = assemble("sauer_4", 5.0, 5.0, 3.0);
  BOOST_REQUIRE_EQUAL(four.size(), printed.size());
  for (std::size_t k = 0; k < printed.size(); ++k) {
    BOOST_TEST(std::abs(orientation(four[k]) - printed[k][0]) < 5.1e-5);
    // Positions come from angles that were bisected to a few digits.
    BOOST_TEST(std::abs(four[k]["x"].get<double>() - printed[k][1]) < 1.1e-4);
    BOOST_TEST(std::abs(four[k]["y"].get<double>() - printed[k][2]) < 1.1e-4);
  }
  const json six = assemble("sauer_4", 5.0, 7.0, 3.0);
  BOOST_TEST(six.size() == 6U);
  for (const json& mode : six) {
    const std::complex<double> at(mode["x"].get<double>(), mode["y"].get<double>());
    BOOST_TEST(std::abs(square({0, 0}, {0, 0}, at, orientation(mode)) - 25.0) < 1e-10);
    BOOST_TEST(std::abs(square({5, 0}, {3, 0}, at, orientation(mode)) - 49.0) < 1e-10);
    BOOST_TEST(std::abs(square({0, 6}, {3, 3}, at, orientation(mode)) - 9.0) < 1e-10);
  }
}

// The workspaces at constant orientation by integration over rays from the centre: on each ray the limits leave
// intervals between roots of quadratic equations.
BOOST_AUTO_TEST_CASE(gosselin_and_jean_has_the_areas_of_its_rays) {
  const double root = std::sqrt(3.0);
  const std::array<std::complex<double>, 3> a{{{-15.0, -5.0 * root}, {15.0, -5.0 * root}, {0.0, 10.0 * root}}};
  const auto area = [&](double turn) {
    constexpr int rays = 40'000;
    double sum = 0.0;
    for (int k = 0; k < rays; ++k) {
      const std::complex<double> ray = std::polar(1.0, 2.0 * pi * (k + 0.5) / rays);
      std::vector<double> ends{0.0};
      const auto centre = [&](std::size_t i) { return a[i] - a[i] / 3.0 * std::polar(1.0, turn); };
      for (std::size_t i = 0; i < 3; ++i) {
        const double along = (std::conj(ray) * centre(i)).real();
        for (const double length : {12.0, 27.0}) {
          const double rest = along * along - std::norm(centre(i)) + length * length;
          if (rest < 0.0) continue;
          for (const double r : {along - std::sqrt(rest), along + std::sqrt(rest)}) {
            if (r > 0.0) ends.push_back(r);
          }
        }
      }
      std::sort(ends.begin(), ends.end());
      for (std::size_t j = 0; j + 1 < ends.size(); ++j) {
        const std::complex<double> middle = 0.5 * (ends[j] + ends[j + 1]) * ray;
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const double length = std::abs(middle - centre(i));
          inside = inside && length >= 12.0 && length <= 27.0;
        }
        if (inside) sum += pi / rays * (ends[j + 1] * ends[j + 1] - ends[j] * ends[j]);
      }
    }
    return sum;
  };
  const auto exact = [](const char* degrees) {
    return document({"workspace", reprise::test::example("gosselin_jean").string(), "--orientation", degrees});
  };
  for (const char* degrees : {"0", "10", "50", "150"}) {
    const double by_rays = area(std::stod(degrees) * pi / 180.0);
    BOOST_TEST(std::abs(exact(degrees)["area"].get<double>() - by_rays) < 1e-5 * by_rays, degrees);
  }
  // Three equal parts at 0, by symmetry.
  const json parts = exact("0")["components"];
  BOOST_REQUIRE_EQUAL(parts.size(), 3U);
  for (const json& part : parts) {
    BOOST_TEST(std::abs(part["area"].get<double>() - parts[0]["area"].get<double>()) < 1e-10);
  }
}

// The pose of the published program: (10, 80), -20 degrees.
BOOST_AUTO_TEST_CASE(schulz_has_the_lengths_of_its_pose_and_comes_back_to_it) {
  const std::complex<double> at(10.0, 80.0);
  const double turn = -20.0 * pi / 180.0;
  const std::array<double, 3> lengths{std::sqrt(6500.0), std::sqrt(square({40, 10}, {25, 0}, at, turn)),
                                      std::sqrt(square({90, -20}, {60, 0}, at, turn))};
  const json pose = document({"pose", published("schulz"), "--at", "10", "80", "--orientation", "-20"});
  BOOST_TEST(pose["unit"] == "mm");
  for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(std::abs(pose["legs"][i].get<double>() - lengths[i]) < 1e-12);
  const json modes = assemble("schulz", lengths[0], lengths[1], lengths[2]);
  BOOST_TEST(std::any_of(modes.begin(), modes.end(), [](const json& mode) {
    return std::abs(mode["x"].get<double>() - 10.0) < 1e-9 && std::abs(mode["y"].get<double>() - 80.0) < 1e-9 &&
           std::abs(mode["orientation_deg"].get<double>() + 20.0) < 1e-9;
  }));
}

// Leg lengths (14.98, 15.38, 12): six real assembly modes.
BOOST_AUTO_TEST_CASE(innocenti_has_six_modes) {
  // The angle follows from the sides.
  const double beta = std::acos((17.04 * 17.04 + 20.84 * 20.84 - 16.54 * 16.54) / (2.0 * 17.04 * 20.84));
  BOOST_TEST(std::abs(beta - 0.882603) < 5e-7);
  const json modes = assemble("innocenti", 14.98, 15.38, 12.0);
  BOOST_TEST(modes.size() == 6U);
  for (const json& mode : modes) {
    const std::complex<double> at(mode["x"].get<double>(), mode["y"].get<double>());
    BOOST_TEST(std::abs(square({0, 0}, {0, 0}, at, orientation(mode)) - 14.98 * 14.98) < 1e-9);
    BOOST_TEST(std::abs(square({15.91, 0}, {17.04, 0}, at, orientation(mode)) - 15.38 * 15.38) < 1e-9);
    BOOST_TEST(std::abs(square({0, 10}, std::polar(20.84, 0.882603), at, orientation(mode)) - 144.0) < 1e-9);
  }
}

// The map from poses to squared leg lengths is proper and misses the negative ones, so that its degree is 0: as many
// modes have a Jacobian of positive determinant as of negative one. Husty's theorem is about these two classes.
BOOST_AUTO_TEST_CASE(husty_has_as_many_modes_of_either_sign) {
  for (const double l1 : {8.0, 11.0, 14.0, 17.0}) {
    for (const double l2 : {8.5, 12.5, 16.5}) {
      const json modes = assemble("husty", l1, l2, 10.0);
      int balance = 0;
      for (const json& mode : modes) {
        const auto of = [&](const char* key) { return mode[key].dump(); };
        const json pose =
            document({"pose", published("husty"), "--at", of("x"), of("y"), "--orientation", of("orientation_deg")});
        Eigen::Matrix3d jacobian;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            jacobian(i, j) = pose["jacobian"][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>();
          }
        }
        BOOST_TEST(std::abs(pose["legs"][2].get<double>() - 10.0) < 1e-9);
        balance += jacobian.determinant() > 0.0 ? 1 : -1;
      }
      BOOST_TEST(balance == 0, l1 << ", " << l2);
    }
  }
}
