// Certificates and what becomes of them when they are altered.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <sstream>

#include "reprise/bounds/global_optimum.hpp"
#include "reprise/checker/check_certificate.hpp"
#include "sample_count.hpp"

namespace {

using namespace reprise;

SynthesisTask task_of(Shape shape, double scale, double rotation = 0.0) {
  const std::array<Interval, 3> lengths{Interval{std::sqrt(2.0), 2.0}, Interval{std::sqrt(2.0), 2.0},
                                        Interval{1.0, std::sqrt(3.0)}};
  return {PrescribedWorkspace("prescribed", std::move(shape), {{1.0, 1.5}, scale, rotation}),
          slices({0.0}),
          DesignSpace::collinear(lengths),
          {Normalisation::printed, {}}};
}

SynthesisTask ellipse_task() { return task_of(Ellipse{{1.75, 1.0}}, 0.2); }

struct Proved {
  BoundClaim claim;
  std::string tree;
};

Proved prove(const SynthesisTask& task, int side = 1, double gap = 1e-3) {
  const GlobalOptimum found = prove_global_optimum(task, {.gap = gap, .side = side});
  return {{side, found.upper, found.certificate.root}, to_text(found.certificate)};
}

const Proved& of_ellipse() {
  static const Proved proved = prove(ellipse_task());
  return proved;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

BOOST_AUTO_TEST_CASE(what_the_prover_writes_is_accepted) {
  const CheckResult result = check_certificate(ellipse_task(), of_ellipse().claim, of_ellipse().tree);
  BOOST_TEST(result.proved, result.failure);
  BOOST_TEST(result.leaves > 100);
  BOOST_TEST(result.lines == static_cast<long>(lines_of(of_ellipse().tree).size()));
}

BOOST_AUTO_TEST_CASE(other_outlines_and_the_other_side_are_accepted) {
  for (const Shape& shape :
       {Shape(Rectangle{2.0, 1.6}), Shape(Polygon{{{1.0, -0.8}, {0.9, 0.9}, {-1.0, 0.7}, {-0.8, -0.9}}}),
        Shape(PolarTable{{0.3, 1.7, 3.0, 4.4}, {1.0, 0.9, 1.1, 0.8}})}) {
    const SynthesisTask task = task_of(shape, 0.2, 0.3);
    const Proved proved = prove(task, -1, 0.02);
    const CheckResult result = check_certificate(task, proved.claim, proved.tree);
    BOOST_TEST(result.proved, result.failure);
  }
}

BOOST_AUTO_TEST_CASE(a_stronger_claim_is_refused) {
  BoundClaim claim = of_ellipse().claim;
  claim.bound = 0.9323;  // a design is better than this
  BOOST_TEST(!check_certificate(ellipse_task(), claim, of_ellipse().tree).proved);
  // Base joints from which the centre is reached are left out.
  for (std::size_t i = 0; i < 4; ++i) {
    claim = of_ellipse().claim;
    claim.root[i].upper = 0.6 * claim.root[i].upper + 0.4 * claim.root[i].lower;
    BOOST_TEST(!check_certificate(ellipse_task(), claim, of_ellipse().tree).proved);
  }
  // Another problem's certificate.
  BOOST_TEST(!check_certificate(task_of(Ellipse{{1.75, 1.0}}, 0.15), of_ellipse().claim, of_ellipse().tree).proved);
}

BOOST_AUTO_TEST_CASE(other_families_are_refused) {
  const SynthesisTask task = ellipse_task();
  const DesignSpace& own = task.designs;
  const auto refused = [&](const DesignSpace& designs) {
    SynthesisTask other = task;
    other.designs = designs;
    BOOST_CHECK_THROW(check_certificate(other, of_ellipse().claim, of_ellipse().tree), std::invalid_argument);
  };
  // Every coefficient of the family matters.
  for (Eigen::Index row = 0; row < 12; ++row) {
    for (Eigen::Index column = 0; column < 5; ++column) {
      Eigen::MatrixXd joints = own.joint_map();
      joints(row, column) += 0.5;
      refused({own.origin(), own.names(), joints, own.length_map()});
    }
  }
  Eigen::MatrixXd lengths = own.length_map();
  lengths(1, 4) = 0.5;
  refused({own.origin(), own.names(), own.joint_map(), lengths});
  refused({own.origin(), own.names(), own.joint_map(), own.length_map(), Eigen::VectorXd::Constant(5, -1.0),
           Eigen::VectorXd::Constant(5, 1.0)});
  // The family moved by a reference.
  refused({own.origin(), own.names(), own.joint_map(), own.length_map(), {}, {}, Eigen::VectorXd::Constant(5, 0.1)});
  std::vector<Leg> legs(own.origin().legs().begin(), own.origin().legs().end());
  legs[1].base_angle = Interval{0.1, 1.0};
  refused({Manipulator("with angles", legs), own.names(), own.joint_map(), own.length_map()});
  legs.pop_back();
  refused({Manipulator("of two legs", legs), {"x"}, Eigen::MatrixXd::Zero(8, 1), Eigen::MatrixXd::Zero(4, 1)});
}

/// The tree of an altered certificate may still be a proof: a bound that has some room does not need every bit of every
/// number. But none may prove what is false: all of these say that no design is better than one that is known.
BOOST_AUTO_TEST_CASE(no_alteration_proves_what_is_false) {
  BoundClaim false_claim = of_ellipse().claim;
  false_claim.bound = 0.9323;
  const std::vector<std::string> lines = lines_of(of_ellipse().tree);
  std::mt19937 engine(4);
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine);
  };
  for (long k = 0; k < (test::few_samples ? 60 : 1'000); ++k) {
    std::vector<std::string> altered = lines;
    const std::size_t at = below(altered.size());
    switch (below(4)) {
      case 0:  // a sign of the line
        altered[at][below(altered[at].size())] = "0123456789abcdefSYXLNMFB-+. "[below(28)];
        break;
      case 1:  // a line too few
        altered.erase(altered.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 2:  // a line twice
        altered.insert(altered.begin() + static_cast<std::ptrdiff_t>(at), altered[at]);
        break;
      default:  // two lines in each other's place
        std::swap(altered[at], altered[below(altered.size())]);
        break;
    }
    BOOST_TEST(!check_certificate(ellipse_task(), false_claim, text_of(altered)).proved);
  }
}

/// Numbers and lines that a proof cannot do without.
BOOST_AUTO_TEST_CASE(what_matters_may_not_be_altered) {
  const std::vector<std::string> lines = lines_of(of_ellipse().tree);
  const auto refused = [&](const std::vector<std::string>& altered) {
    const CheckResult result = check_certificate(ellipse_task(), of_ellipse().claim, text_of(altered));
    BOOST_TEST(!result.proved);
    BOOST_TEST(result.failure.ends_with("."));
  };
  long altered_lines = 0;
  for (std::size_t at = 0; at < lines.size(); at += lines.size() / 100) {
    std::vector<std::string> altered = lines;
    altered.erase(altered.begin() + static_cast<std::ptrdiff_t>(at));
    refused(altered);
    // The other side of the limit, and the swap of a line for a symmetry that does not hold there.
    for (const char* line : {"S", "X", "nonsense", "N 0 0 0x1p+1", "N 0 7 0x0p+0", "M 0", ""}) {
      if (lines[at][0] == 'S' || lines[at][0] == 'X' || lines[at][0] == 'Y') continue;
      altered = lines;
      altered[at] = line;
      refused(altered);
      ++altered_lines;
    }
  }
  BOOST_TEST(altered_lines > 500);
  std::vector<std::string> altered = lines;
  altered.emplace_back("S");
  refused(altered);
  refused({});
}

}  // namespace
