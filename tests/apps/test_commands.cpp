// What the commands say against closed forms and invariances.

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "reprise/base/constants.hpp"
#include "reprise/geometry/polygon.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/table.hpp"
#include "reprise/study/problem_file.hpp"
#include "running.hpp"
#include "temporary_folder.hpp"

using namespace reprise;
using boost::test_tools::tolerance;
using nlohmann::json;
using reprise::test::Ended;
using reprise::test::example;
using reprise::test::run;

namespace {

/// Two legs that end in the working point, of lengths 1 to 2, their bases at (0, 0) and (d, 0).
std::string two_legs(double d) {
  return "[manipulator]\nname = 'two'\n[[manipulator.leg]]\nbase = [0, 0]\nplatform = [0, 0]\nlength = [1, 2]\n"
         "[[manipulator.leg]]\nbase = [" +
         std::to_string(d) + ", 0]\nplatform = [0, 0]\nlength = [1, 2]\n";
}

/// The manipulator of a file, turned, moved and in another unit.
std::string moved(const std::filesystem::path& file, double turn, const Eigen::Vector2d& shift, double unit) {
  ManipulatorInput input = read_manipulator(file);
  std::vector<Leg> legs = input.manipulator.legs();
  for (Leg& leg : legs) {
    leg.base_joint = unit * (Eigen::Rotation2Dd(turn) * leg.base_joint + shift);
    leg.platform_joint *= unit;
    leg.length = {unit * leg.length.lower, unit * leg.length.upper};
    if (leg.base_angle) leg.base_angle = Interval{leg.base_angle->lower + turn, leg.base_angle->upper + turn};
  }
  input.manipulator = Manipulator("moved", legs);
  input.as_design = false;
  return to_toml(input);
}

json document(std::vector<std::string> arguments) {
  arguments.emplace_back("--json");
  const Ended ended = run(arguments);
  BOOST_REQUIRE_MESSAGE(ended.code == 0, ended.err);
  BOOST_TEST(ended.err == "");
  return ended.document();
}

std::vector<Eigen::Vector2d> points(const json& list) {
  std::vector<Eigen::Vector2d> result;
  for (const json& point : list) result.emplace_back(point[0].get<double>(), point[1].get<double>());
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_pose_of_right_angles_has_its_closed_form) {
  const TemporaryFolder folder;
  const std::string file = folder.write("m.toml", two_legs(3.0)).string();
  const json pose = document({"pose", file, "--at", "1.5", "1.5"});
  BOOST_TEST(pose["legs"][0].get<double>() == 1.5 * std::numbers::sqrt2, tolerance(1e-15));
  BOOST_TEST(pose["kappa_inv"].get<double>() == 1.0, tolerance(1e-14));  // the legs are at right angles
  BOOST_TEST(pose["kappa"].get<double>() == 1.0, tolerance(1e-14));
  BOOST_TEST(pose["kappa_inv_2norm"].get<double>() == 1.0, tolerance(1e-14));
  BOOST_TEST(pose["base_angles_deg"][0].get<double>() == 45.0, tolerance(1e-14));
  BOOST_TEST(!pose["within_limits"].get<bool>());  // 2.12 is longer than 2
  const json singular = document({"pose", file, "--at", "1.5", "0"});
  BOOST_TEST(singular["singular"].get<bool>());
  BOOST_TEST(singular["kappa"].is_null());
  BOOST_TEST(singular["within_limits"].get<bool>());
}

BOOST_AUTO_TEST_CASE(assembly_modes_have_the_lengths_asked_for) {
  for (const std::string name : {"M1", "triangle"}) {
    const std::string file = example(name).string();
    const json pose = document({"pose", file, "--at", "0.9", "1.45", "--orientation", "7"});
    std::vector<std::string> arguments{"assemble", file, "--lengths"};
    for (const json& length : pose["legs"]) arguments.push_back(json(length).dump());
    const json modes = document(arguments)["modes"];
    bool has_pose = false;
    for (const json& mode : modes) {
      const auto text = [&](const char* key) { return mode[key].dump(); };
      const json there =
          document({"pose", file, "--at", text("x"), text("y"), "--orientation", text("orientation_deg")});
      for (std::size_t i = 0; i < 3; ++i) {
        BOOST_TEST(there["legs"][i].get<double>() == pose["legs"][i].get<double>(), tolerance(1e-9));
      }
      has_pose = has_pose || std::abs(mode["orientation_deg"].get<double>() - 7.0) < 1e-6;
    }
    BOOST_TEST(has_pose);
  }
  BOOST_TEST(run({"assemble", example("two_legs").string(), "--lengths", "1", "1", "1"}).code == 2);
}

// Two annuli: discs less each other's holes. The lens of two discs of radius 2 at the distance d, less two lenses of
// radii 1 and 2, plus that of radius 1; here the holes do not meet.
BOOST_AUTO_TEST_CASE(the_workspace_of_two_legs_is_made_of_lenses) {
  const auto lens = [](double r, double s, double d) {
    const double a = std::acos((d * d + r * r - s * s) / (2.0 * d * r));
    const double b = std::acos((d * d + s * s - r * r) / (2.0 * d * s));
    return r * r * (a - 0.5 * std::sin(2.0 * a)) + s * s * (b - 0.5 * std::sin(2.0 * b));
  };
  const double d = 2.5;
  const TemporaryFolder folder;
  const std::string file = folder.write("m.toml", two_legs(d)).string();
  const double area = lens(2, 2, d) - 2.0 * lens(1, 2, d);
  const json exact = document({"workspace", file});
  BOOST_TEST(exact["area"].get<double>() == area, tolerance(1e-12));
  BOOST_TEST(exact["components"].size() == 1U);
  double sum = 0.0;
  for (const json& component : exact["components"]) {
    sum += component["area"].get<double>();
    BOOST_TEST(signed_area(points(component["boundary"])) == component["area"].get<double>(), tolerance(1e-3));
    BOOST_TEST(component["bifurcation_points"].size() == component["edges"].size());
    for (const Eigen::Vector2d& point : points(component["bifurcation_points"])) {
      for (const double x : {0.0, d}) {
        const double length = (point - Eigen::Vector2d(x, 0.0)).norm();
        BOOST_TEST(std::min(std::abs(length - 1.0), std::abs(length - 2.0)) < 1e-12);
      }
    }
  }
  BOOST_TEST(sum == area, tolerance(1e-12));
  // The chord method's error falls with the square of the chord.
  for (const std::string solver : {"bracketing", "slsqp"}) {
    const double coarse = document({"workspace", file, "--chord", "0.1", "--solver", solver})["area"].get<double>();
    const double fine = document({"workspace", file, "--chord", "0.025", "--solver", solver})["area"].get<double>();
    BOOST_TEST(std::abs(fine - area) < std::abs(coarse - area) / 8.0);
  }
}

BOOST_AUTO_TEST_CASE(holes_are_told_from_components) {
  const TemporaryFolder folder;
  const std::string file = folder.write("m.toml", two_legs(0.0)).string();
  const json annulus = document({"workspace", file});
  BOOST_TEST(annulus["area"].get<double>() == 3.0 * pi, tolerance(1e-12));
  BOOST_REQUIRE_EQUAL(annulus["components"].size(), 1U);
  BOOST_REQUIRE_EQUAL(annulus["components"][0]["holes"].size(), 1U);
  BOOST_TEST(signed_area(points(annulus["components"][0]["holes"][0])) == -pi, tolerance(1e-3));
  const json empty = document({"workspace", folder.write("far.toml", two_legs(9.0)).string()});
  BOOST_TEST(empty["area"].get<double>() == 0.0);
  BOOST_TEST(empty["components"].empty());
}

BOOST_AUTO_TEST_CASE(the_workspace_of_m1_has_its_known_area) {
  const json exact = document({"workspace", example("M1").string(), "--orientation", "0"});
  BOOST_TEST(exact["area"].get<double>() == 0.726983276093924, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_dextrous_workspace_shrinks_with_its_range_and_is_exact_for_none) {
  const std::string file = example("triangle").string();
  const double slice = document({"workspace", file, "--orientation", "3"})["area"].get<double>();
  BOOST_TEST(document({"dextrous", file, "--range", "3", "3"})["area"].get<double>() == slice, tolerance(1e-10));
  const double narrow = document({"dextrous", file, "--range", "0", "6"})["area"].get<double>();
  const double wide = document({"dextrous", file, "--range", "-5", "10"})["area"].get<double>();
  BOOST_TEST(slice > narrow);
  BOOST_TEST(narrow > wide);
}

// What was not traced has no area. M1's two boundaries are 2.5 long each, and the workspace is less than 2 across.
BOOST_AUTO_TEST_CASE(a_boundary_that_was_not_traced_is_no_result) {
  const std::string file = example("M1").string();
  const TemporaryFolder folder;
  for (const std::string command : {"workspace", "dextrous"}) {
    std::vector<std::string> arguments{command, file};
    if (command == "dextrous") arguments.insert(arguments.end(), {"--range", "-1", "1"});
    const auto with_chord = [&](const std::string& chord, bool as_json) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(), {"--chord", chord});
      if (as_json) all.emplace_back("--json");
      return run(all);
    };
    const Ended too_long = with_chord("5", true);
    BOOST_TEST(too_long.code == 1);
    const json found = too_long.document();
    BOOST_TEST(!found["complete"].get<bool>());
    BOOST_TEST(found["area"].is_null());
    BOOST_TEST(found["not_traced"].size() == 2U);
    const std::string text = with_chord("5", false).out;
    BOOST_TEST(contains(text, "NOT COMPLETE: 2 of 2 boundaries were not traced"));
    BOOST_TEST(!contains(text, "area 0"));
    // What is said to do does.
    const std::string advice = found["advice"].get<std::string>();
    const std::string before = "Take a shorter chord, ";
    BOOST_REQUIRE(advice.starts_with(before));
    const std::string shorter = advice.substr(before.size(), advice.find(' ', before.size()) - before.size());
    const Ended traced = with_chord(shorter, true);
    BOOST_TEST(traced.code == 0);
    BOOST_TEST(traced.document()["advice"].is_null());
    // Too many points are refused at once, and the chord named is long enough.
    for (const std::string chord : {"1e-6", "1e-300"}) {
      const Ended refused = with_chord(chord, false);
      BOOST_TEST(refused.code == 1);
      BOOST_TEST(refused.out == "");
      BOOST_TEST(contains(refused.err, "the chord is " + fmt::format("{}", std::stod(chord))));
      BOOST_TEST(contains(refused.err, "no more than 100000 chords are traced; take a chord of "), refused.err);
      const std::string least = refused.err.substr(refused.err.find("take a chord of ") + 16);
      BOOST_TEST(std::stod(least) > 2.5e-5);
      BOOST_TEST(std::stod(least) < 1e-4);
    }
  }
  // A part of a workspace is not the workspace: the rim of a disc is traced, the small hole in it is not.
  const std::string parts =
      "[manipulator]\nname = 'parts'\n[[manipulator.leg]]\nbase = [0, 0]\nplatform = [0, 0]\nlength = [0.02, 2]\n"
      "[[manipulator.leg]]\nbase = [1, 0]\nplatform = [0, 0]\nlength = [0, 9]\n";
  const Ended ended = run({"workspace", folder.write("parts.toml", parts).string(), "--chord", "0.1", "--json"});
  BOOST_TEST(ended.code == 1);
  const json document_ = ended.document();
  BOOST_REQUIRE(document_["components"].size() == 1U);
  BOOST_TEST(document_["area"].is_null());
  BOOST_TEST(document_["components"][0]["area"].is_null());
}

// Inside every interval all limits hold, outside of all of them one is violated.
BOOST_AUTO_TEST_CASE(orientation_intervals_are_where_the_limits_hold) {
  const std::string file = example("triangle").string();
  const json intervals = document({"orientation", file, "--at", "20", "100"})["intervals_deg"];
  BOOST_REQUIRE(!intervals.empty());
  for (double phi = -175.5; phi < 180.0; phi += 9.0) {
    bool inside = false;
    for (const json& interval : intervals) {
      for (const double turned : {phi, phi + 360.0}) {
        inside = inside || (interval[0].get<double>() <= turned && turned <= interval[1].get<double>());
      }
    }
    const json pose = document({"pose", file, "--at", "20", "100", "--orientation", std::to_string(phi)});
    BOOST_TEST(pose["within_limits"].get<bool>() == inside, phi);
  }
}

BOOST_AUTO_TEST_CASE(neither_frame_nor_unit_matter) {
  const double turn = 0.4;
  const double unit = 25.4;
  const Eigen::Vector2d shift(30.0, -80.0);
  const TemporaryFolder folder;
  const std::string here = example("triangle").string();
  const std::string there = folder.write("moved.toml", moved(here, turn, shift, unit)).string();
  const std::string turn_deg = std::to_string(10.0 + turn * 180.0 / pi);
  const auto area = [&](const std::string& file, const std::string& orientation) {
    return document({"workspace", file, "--orientation", orientation})["area"].get<double>();
  };
  BOOST_TEST(area(there, turn_deg) == unit * unit * area(here, "10"), tolerance(1e-7));
  const json a = document({"conditioning", here, "--orientation", "10", "--grid", "5"});
  const json b = document({"conditioning", there, "--orientation", turn_deg, "--grid", "5"});
  BOOST_TEST(b["kappa_inv_max"].get<double>() == a["kappa_inv_max"].get<double>(), tolerance(1e-5));
  BOOST_TEST(std::abs(b["kappa_inv_min"].get<double>() - a["kappa_inv_min"].get<double>()) < 1e-5);
  BOOST_TEST(b["global_conditioning_index"].get<double>() == a["global_conditioning_index"].get<double>(),
             tolerance(1e-3));
}

// At the angle alpha between two legs kappa^-1 = sin alpha: its mean over the workspace by another formula, its
// extremes.
BOOST_AUTO_TEST_CASE(conditioning_of_two_legs_is_the_sine_of_their_angle) {
  const TemporaryFolder folder;
  const double d = 2.5;
  const json conditioning = document({"conditioning", folder.write("m.toml", two_legs(d)).string(), "--grid", "41"});
  // In the lengths l, m of the legs the area element is dl dm / sin(alpha), so that the integral of sin(alpha) is the
  // area of the lengths with l + m > d in the square from 1 to 2, once above and once below the line of the bases.
  BOOST_TEST(conditioning["global_conditioning_index"].get<double>() * conditioning["area"].get<double>() ==
                 2.0 * (1.0 - 0.125),
             tolerance(1e-4));
  BOOST_TEST(conditioning["kappa_inv_max"].get<double>() == 1.0, tolerance(1e-6));
  // On the line of the bases the legs are parallel.
  BOOST_TEST(conditioning["kappa_inv_min"].get<double>() == 0.0);
  BOOST_TEST(conditioning["singular_inside"].get<bool>());
}

namespace {

struct TableLeg {
  Eigen::Vector2d base;
  Eigen::Vector2d platform;
};

/// A manipulator of legs with lengths from 150 to 250 about a table, as a file has it.
std::string positioning_table(const std::vector<TableLeg>& legs) {
  std::string text = "[manipulator]\nname = 'table'\ncharacteristic_length = 50\n";
  for (const TableLeg& leg : legs) {
    text += fmt::format("[[manipulator.leg]]\nbase = [{}, {}]\nplatform = [{}, {}]\nlength = [150, 250]\n",
                        leg.base.x(), leg.base.y(), leg.platform.x(), leg.platform.y());
  }
  return text;
}

const std::vector<TableLeg> symmetric_legs{{{-180, -100}, {-40, -25}}, {{180, -100}, {40, -25}}, {{0, 220}, {0, 45}}};

}  // namespace

// The lines of all three legs meet in one point wherever the table is on its mirror line.
BOOST_AUTO_TEST_CASE(a_mirror_symmetric_table_is_singular_on_its_mirror_line) {
  const TemporaryFolder folder;
  const std::string file = folder.write("table.toml", positioning_table(symmetric_legs)).string();
  const json found = document({"conditioning", file, "--grid", "5"});
  BOOST_TEST(found["singular_poses"] == "some");
  BOOST_TEST(found["singular_inside"].get<bool>());
  BOOST_TEST(found["kappa_inv_min"].get<double>() == 0.0);
  BOOST_TEST(found["kappa_inv_min_bound"].get<double>() == 0.0);
  const json at = found["singular_at"];
  const json pose = document({"pose", file, "--at", at[0].dump(), at[1].dump()});
  BOOST_TEST(pose["singular"].get<bool>());
  BOOST_TEST(pose["within_limits"].get<bool>());
  const Ended ended = run({"conditioning", file, "--grid", "5"});
  BOOST_TEST(ended.out.find("singular poses              yes, at x = ") != std::string::npos, ended.out);
  BOOST_TEST(ended.out.find("least kappa^-1              0 ") != std::string::npos, ended.out);
}

BOOST_AUTO_TEST_CASE(legs_with_one_platform_joint_are_singular_everywhere) {
  const TemporaryFolder folder;
  std::vector<TableLeg> legs = symmetric_legs;
  for (TableLeg& leg : legs) leg.platform = {10.0, 7.0};
  const json found = document(
      {"conditioning", folder.write("m.toml", positioning_table(legs)).string(), "--orientation", "20", "--grid", "5"});
  BOOST_TEST(found["singular_poses"] == "all");
  BOOST_TEST(found["kappa_inv_min"].get<double>() == 0.0);
}

// The stated least value lies between the bound proved and whatever any map shows.
BOOST_AUTO_TEST_CASE(the_least_value_is_no_more_than_any_map_shows) {
  const TemporaryFolder folder;
  std::vector<std::string> files{example("M1").string(), example("triangle").string()};
  std::vector<TableLeg> four = symmetric_legs;
  four[2].base.x() += 60.0;
  four.push_back({{-100, 180}, {-30, 30}});
  files.push_back(folder.write("four.toml", positioning_table(four)).string());
  for (const std::string& file : files) {
    for (const std::string orientation : {"-12", "8", "25"}) {
      const json found = document({"conditioning", file, "--orientation", orientation, "--grid", "61"});
      if (found["kappa_inv_min"].is_null()) continue;
      const double least = found["kappa_inv_min"].get<double>();
      double shown = 1.0;
      for (const json& column : found["map"]["kappa_inv"]) {
        for (const json& value : column) {
          if (!value.is_null()) shown = std::min(shown, value.get<double>());
        }
      }
      BOOST_TEST(least <= shown + 1e-9);
      BOOST_TEST(found["kappa_inv_min_bound"].get<double>() <= least);
      BOOST_TEST(found["singular_poses"] == (least > 0.0 ? "none" : "some"), file << " " << orientation);
      if (least > 0.0) BOOST_TEST(least - found["kappa_inv_min_bound"].get<double>() <= 1e-6);
    }
  }
}

// A great characteristic length makes all values small; they keep their digits.
BOOST_AUTO_TEST_CASE(small_bounds_keep_their_digits) {
  const TemporaryFolder folder;
  std::string content = read_file(example("triangle"));
  content.insert(content.find("[manipulator]") + std::string("[manipulator]").size(), "\ncharacteristic_length = 1e6");
  const std::string file = folder.write("small.toml", content).string();
  const std::vector<std::string> arguments{"conditioning", file, "--orientation", "25", "--grid", "5"};
  const double bound = document(arguments)["kappa_inv_min_bound"].get<double>();
  BOOST_TEST(bound > 0.0);
  BOOST_TEST(bound < 1e-3);
  const std::string text = run(arguments).out;
  const std::string label = "proved to be at least";
  const double shown = std::stod(text.substr(text.find(label) + label.size()));
  BOOST_TEST(shown <= bound);
  BOOST_TEST(shown == bound, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(a_synthesis_reaches_its_workspace_and_its_design_is_a_manipulator_file) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  std::filesystem::create_directory(out);
  const json found = document({"synthesize", example("P2").string(), "--points", "200", "--out", out});
  BOOST_TEST(found["status"] == "converged");
  BOOST_TEST(found["reaches_workspace"].get<bool>());
  BOOST_TEST(found["design"].size() == 5U);
  BOOST_TEST(found["kappa_inv_min"].get<double>() > 0.932);  // 0.927 is what the thesis prints
  BOOST_TEST(found["kappa_inv_min"].get<double>() > found["start_kappa_inv_min"].get<double>());
  BOOST_TEST(read_file(folder / "out/manipulator.toml") == found["manipulator_toml"].get<std::string>());
  const ManipulatorInput again = read_manipulator(folder / "out/manipulator.toml");
  const auto design = to_vector(*collinear_design(again.manipulator));
  for (Eigen::Index i = 0; i < 5; ++i) {
    BOOST_TEST(design[i] == found["design"][static_cast<std::size_t>(i)].get<double>(), tolerance(1e-15));
  }
  const Table history = read_table(folder / "out/history.csv");
  BOOST_TEST(history.rows() == found["history"].size());
  // Its first iterate is the start, and one of its iterates is the design found.
  bool ends_there = false;
  for (const json& point : found["history"]) ends_there = ends_there || point["design"] == found["design"];
  BOOST_TEST(ends_there);
  BOOST_TEST(found["history"][0]["design"] == found["runs"][0]["start"]);
  BOOST_TEST(history.number(0, "x_C") == found["history"][0]["design"][0].get<double>(), tolerance(1e-15));
  // The proof that no design is better comes unasked, with certificates that hold.
  BOOST_TEST(found["global"]["settled"].get<bool>());
  BOOST_TEST(found["global"]["bound"].get<double>() >= found["kappa_inv_min_bound"].get<double>());
  BOOST_TEST(found["global"]["gap"].get<double>() <= 1e-6);
  for (const char* name : {"certificate.toml", "certificate_turned.toml"}) {
    BOOST_TEST(document({"check", out + "/" + name})["proved"].get<bool>());
  }
  // A point of the outline is in the workspace found, at the height of its top.
  const json pose = document({"pose", out + "/manipulator.toml", "--at", "1", "1.69"});
  BOOST_TEST(pose["within_limits"].get<bool>());
}

// The same problem in another unit has the same solution in that unit.
BOOST_AUTO_TEST_CASE(a_synthesis_does_not_depend_on_the_unit_of_length) {
  const TemporaryFolder folder;
  const auto problem = [](double unit) {
    const auto number = [unit](double length) { return std::to_string(length * unit); };
    return "[manipulator]\nname = 'm'\ndesign = [" + number(-1) + ", 0, " + number(1) + ", " + number(2) + ", " +
           number(1) + "]\nlength = [[" + number(1.4) + ", " + number(2) + "], [" + number(1.4) + ", " + number(2) +
           "], [" + number(1) + ", " + number(1.7) + "]]\n[workspace]\nkind = 'circle'\nradius = " + number(0.2) +
           "\ncentre = [" + number(1) + ", " + number(1.5) + "]\n[orientations]\nrange_deg = [-3, 3]\n";
  };
  const json one =
      document({"synthesize", folder.write("one.toml", problem(1.0)).string(), "--points", "100", "--no-prove"});
  const json other =
      document({"synthesize", folder.write("other.toml", problem(1024.0)).string(), "--points", "100", "--no-prove"});
  BOOST_TEST(one["reaches_workspace"].get<bool>());
  BOOST_TEST(other["kappa_inv_min"].get<double>() == one["kappa_inv_min"].get<double>(), tolerance(1e-6));
  for (std::size_t i = 0; i < 5; ++i) {
    BOOST_TEST(other["design"][i].get<double>() == 1024.0 * one["design"][i].get<double>(), tolerance(1e-4));
  }
}

BOOST_AUTO_TEST_CASE(further_starts_are_no_worse_and_always_the_same) {
  const std::vector<std::string> arguments{
      "synthesize", example("circle").string(), "--points", "60", "--max-evaluations", "100", "--no-prove", "--starts"};
  const auto with = [&](const std::string& starts, const std::string& seed) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {starts, "--seed", seed});
    return document(all);
  };
  const json one = with("1", "1");
  const json three = with("3", "1");
  BOOST_TEST(three["runs"].size() == 3U);
  BOOST_TEST(three["kappa_inv_min"].get<double>() >= one["kappa_inv_min"].get<double>());
  BOOST_TEST((three == with("3", "1")));
  BOOST_TEST((three["runs"][1] != with("3", "2")["runs"][1]));
}

// With few evaluations the optimizer is far from the best design; the proof, which goes through all of them, is not.
BOOST_AUTO_TEST_CASE(a_better_design_that_the_proof_finds_is_the_answer) {
  const std::vector<std::string> arguments{"synthesize", example("P2").string(), "--points",
                                           "40",         "--max-evaluations",    "2"};
  std::vector<std::string> without = arguments;
  without.emplace_back("--no-prove");
  const Ended alone = run([&] {
    auto all = without;
    all.emplace_back("--json");
    return all;
  }());
  BOOST_TEST(alone.document()["global"].is_null());
  const json found = document(arguments);
  BOOST_TEST(found["reaches_workspace"].get<bool>());
  BOOST_TEST(found["kappa_inv_min"].get<double>() > 0.9323);
  BOOST_TEST(found["kappa_inv_min"].get<double>() <= found["global"]["bound"].get<double>() + 1e-12);
  BOOST_TEST(found["runs"][0]["design"] == alone.document()["runs"][0]["design"]);
  BOOST_TEST(run(arguments).out.find("The proof found a better design than the optimizer") != std::string::npos);
  // For other families there is none, and nothing to prove.
  BOOST_TEST(run({"synthesize", example("rectangle").string(), "--points", "20", "--prove"}).code == 2);
  without.emplace_back("--prove");
  BOOST_TEST(run(without).code == 2);
}

// Leg 1 of [1, 2] from the centre of a circle of radius 3: 1 too short, and its hole is in the middle.
BOOST_AUTO_TEST_CASE(an_impossible_workspace_ends_with_advice) {
  const TemporaryFolder folder;
  const std::string problem = two_legs(3.0) +
                              "[workspace]\nkind = 'circle'\nradius = 3\ncentre = [0, 0]\n[orientations]\n"
                              "slices_deg = [0]\n[design]\nfree = ['base_2_x']\n";
  const std::string file = folder.write("p.toml", problem).string();
  const Ended ended = run({"synthesize", file, "--points", "40", "--json"});
  BOOST_TEST(ended.code == 1);
  BOOST_TEST(ended.err == "");
  const json document_ = ended.document();
  BOOST_TEST(!document_["reaches_workspace"].get<bool>());
  BOOST_TEST(document_["status"] != "converged");
  BOOST_TEST(document_["violation"].get<double>() >= 1.0);  // leg 1 is 2 long at most
  const Ended text = run({"synthesize", file, "--points", "40"});
  BOOST_TEST(text.code == 1);
  BOOST_TEST(contains(text.out, "does NOT reach"));
  BOOST_TEST(contains(text.out, "No design was found that reaches the workspace."));
}

// Leg 1 from distance 4, leg 2 from a distance that is free: a circle of radius R needs lengths from 4 - R to 4 + R.
BOOST_AUTO_TEST_CASE(advice_is_the_geometry_of_the_problem) {
  const TemporaryFolder folder;
  const auto problem = [](double radius) {
    return "[manipulator]\nname = 'two'\n[[manipulator.leg]]\nbase = [-4, 0]\nplatform = [0, 0]\n"
           "length = [1.5, 5]\n[[manipulator.leg]]\nbase = [0, 3]\nplatform = [0, 0]\nlength = [1.5, 20]\n"
           "[workspace]\nkind = 'circle'\nradius = " +
           std::to_string(radius) +
           "\ncentre = [0, 0]\n[orientations]\nslices_deg = [0]\n[design]\nfree = ['base_2']\nwithin = 6\n";
  };
  const std::string file = folder.write("p.toml", problem(2.0)).string();
  const Ended ended = run({"synthesize", file, "--points", "40", "--json"});
  BOOST_TEST(ended.code == 1);
  const json advice = ended.document()["advice"];
  BOOST_TEST(advice["violation"].get<double>() == 1.0, tolerance(1e-6));
  BOOST_REQUIRE(advice["binding"].size() == 1U);
  BOOST_TEST(advice["binding"][0]["limit"] == "leg 1, maximum length");
  BOOST_TEST(advice["binding"][0]["at"][0].get<double>() == 2.0, tolerance(1e-6));
  std::map<std::string, json> changes;
  for (const json& change : advice["changes"]) {
    changes[change["kind"].get<std::string>() + (change["leg"].is_null() ? "" : " of one leg")] = change;
  }
  BOOST_TEST(changes.size() == 4U);
  // A little more than 1, so that the number is round.
  for (const char* kind : {"lengths", "maximum_lengths", "maximum_lengths of one leg"}) {
    BOOST_TEST(changes[kind]["amount"].get<double>() >= 1.0, kind);
    BOOST_TEST(changes[kind]["amount"].get<double>() <= 1.002, kind);
  }
  BOOST_TEST(changes["workspace"]["share"].get<double>() <= 0.5);
  BOOST_TEST(changes["workspace"]["share"].get<double>() >= 0.498);
  BOOST_TEST(advice["not_found"] == (json{"all minimum lengths", "the bounds of the joints"}));
  // What is said to do does: as a problem of its own, with the design as its start.
  const std::string smaller = problem(1.99 * changes["workspace"]["share"].get<double>());
  BOOST_TEST(run({"synthesize", folder.write("s.toml", smaller).string(), "--points", "40"}).code == 0);
}

BOOST_AUTO_TEST_CASE(optimizers_agree_in_a_comparison) {
  const json compared = document({"compare", example("circle").string(), "--points", "60", "--optimizer",
                                  "dynamic_q,dynamic_q_safeguarded,slsqp,ipopt_lbfgs", "--max-evaluations", "200"});
  BOOST_REQUIRE_EQUAL(compared["runs"].size(), 4U);
  for (const json& one : compared["runs"]) {
    BOOST_TEST(one["reaches_workspace"].get<bool>(), one["optimizer"]);
    BOOST_TEST(one["kappa_inv_min"].get<double>() == compared["runs"][1]["kappa_inv_min"].get<double>(),
               tolerance(1e-4));
  }
}

BOOST_AUTO_TEST_CASE(the_area_formulation_comes_near_the_pointwise_one) {
  // The area that counts as none lets the outline stick out, by more than counts as reached: no answer, exit code 1.
  const Ended ended = run({"synthesize", example("P2").string(), "--formulation", "area", "--optimizer", "dynamic_q",
                           "--no-prove", "--json"});
  const json area = ended.document();
  BOOST_TEST(ended.code == (area["reaches_workspace"].get<bool>() ? 0 : 1));
  BOOST_TEST(area["formulation"] == "area");
  BOOST_TEST(area["kappa_inv_min"].get<double>() > 0.92);
  BOOST_TEST(area["violation"].get<double>() < 2e-3);
}
