// Branch and bound over designs: what is said of boxes against samples of them, and whole searches.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "box_examiner.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/bounds/global_optimum.hpp"
#include "reprise/synthesis/assessment.hpp"
#include "reprise/synthesis/semi_infinite.hpp"
#include "sample_count.hpp"

namespace {

using namespace reprise;
using namespace reprise::rigorous;

const std::array<Interval, 3> lengths{Interval{std::sqrt(2.0), 2.0}, Interval{std::sqrt(2.0), 2.0},
                                      Interval{1.0, std::sqrt(3.0)}};

SynthesisTask task_of(Shape shape, double scale, std::vector<OrientationRange> orientations) {
  return {PrescribedWorkspace("prescribed", std::move(shape), {{1.0, 1.5}, scale, 0.0}),
          std::move(orientations),
          DesignSpace::collinear(lengths),
          {Normalisation::printed, {}}};
}

/// The reconstructed P2 of Table 5.3, and P3 turned into a task over slices.
SynthesisTask so_task() { return task_of(Ellipse{{1.75, 1.0}}, 0.2, slices({0.0})); }
SynthesisTask mo_task() {
  return task_of(QuarterEllipses{2.0, 2.0, 0.3, 1.14}, 0.9 / 7.0, slices({-5.0 * degree, 0.0, 5.0 * degree}));
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double lower, double upper) { return std::uniform_real_distribution(lower, upper)(engine_); }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_); }

 private:
  std::mt19937 engine_;
};

/// A box about a random design of the root box; `size` is its half width as a share of the root's.
DesignBox random_box(Random& random, double size) {
  constexpr std::array<Interval, 5> root{{{-1.0, 3.0}, {-1.0, 3.0}, {-0.75, 2.75}, {-0.25, 3.25}, {0.5, 2.6}}};
  DesignBox box{};
  for (std::size_t i = 0; i < 5; ++i) {
    const double half = size * random(0.0, 1.0) * (root[i].upper - root[i].lower);
    const double middle = random(root[i].lower, root[i].upper);
    box[i] = {middle - half, middle + half};
  }
  if (random(0.0, 1.0) < 0.5) box[4] = {-box[4].upper, -box[4].lower};
  return box;
}

Variables<double> random_design(Random& random, const DesignBox& box) {
  Variables<double> z{};
  for (std::size_t i = 0; i < 5; ++i) z[i] = random(box[i].lower, box[i].upper);
  return z;
}

Variables<Enclosure> to_enclosures(const DesignBox& box) {
  Variables<Enclosure> all;
  for (std::size_t i = 0; i < 5; ++i) all[i] = Enclosure(box[i].lower, box[i].upper);
  return all;
}

/// A bound of kappa^2 over a box of designs from below.
using LeastCondition = std::function<double(const DesignFamily&, const Orientation&, const Vector2<Enclosure>&,
                                            const Variables<Enclosure>&)>;

/// How many of some random boxes have a sample with a kappa^2, as the library of the kinematics has it, below the
/// bound.
long boxes_below(const LeastCondition& bound, long boxes, double size) {
  const SynthesisTask task = mo_task();
  const DesignFamily family(task, BaseJoints::in_line);
  Random random(1);
  long below = 0;
  for (long k = 0; k < boxes; ++k) {
    const DesignBox box = random_box(random, size);
    const Eigen::Vector2d u = task.prescribed.point(random(0.0, 2.0 * pi));
    const Orientation& orientation = family.orientations()[random.below(3)];
    const double least = bound(family, orientation, {Enclosure(u.x()), Enclosure(u.y())}, to_enclosures(box));
    for (int sample = 0; sample < 4; ++sample) {
      const Manipulator manipulator = task.designs.manipulator(family.to_design(random_design(random, box)));
      const double value = kappa_inverse(manipulator, {u, orientation.angle}, task.conditioning);
      if (value * value * least > 1.0 + 1e-11) {
        ++below;
        break;
      }
    }
  }
  return below;
}

BOOST_AUTO_TEST_CASE(the_bound_of_kappa_is_never_above_a_sample) {
  for (const double size : {0.2, 0.02, 0.001}) {
    BOOST_TEST(boxes_below(least_squared_condition, test::scaled(35'000L), size) == 0);
  }
}

BOOST_AUTO_TEST_CASE(an_unsound_bound_is_found) {
  // Rounded the wrong way by a part in 10^9, in boxes that are points but for as much.
  const LeastCondition too_large = [](const auto&... arguments) {
    return least_squared_condition(arguments...) * (1.0 + 1e-9);
  };
  BOOST_TEST(boxes_below(too_large, test::scaled(2'000L), 1e-12) > 0);
  // Only at the ends of w, where the smallest value may lie between.
  const LeastCondition at_ends = [](const DesignFamily& family, const Orientation& orientation,
                                    const Vector2<Enclosure>& u, Variables<Enclosure> box) {
    const Enclosure r = box[4];
    box[4] = Enclosure(r.lower());
    const double first = least_squared_condition(family, orientation, u, box);
    box[4] = Enclosure(r.upper());
    return std::min(first, least_squared_condition(family, orientation, u, box));
  };
  BOOST_TEST(boxes_below(at_ends, test::scaled(20'000L), 0.2) > 0);
}

/// The square of the condition number by the library of the kinematics, with central differences.
BOOST_AUTO_TEST_CASE(functions_and_gradients_are_those_of_the_manipulator) {
  const SynthesisTask task = mo_task();
  const DesignFamily family(task, BaseJoints::in_line);
  Random random(2);
  long compared = 0;
  for (long k = 0; k < test::scaled(2'000L); ++k) {
    const Variables<double> z = random_design(random, random_box(random, 0.0));
    const Eigen::Vector2d u = task.prescribed.point(random(0.0, 2.0 * pi));
    const Orientation& orientation = family.orientations()[random.below(3)];
    const auto squared_kappa = [&](const Variables<double>& at) {
      const double value =
          kappa_inverse(task.designs.manipulator(family.to_design(at)), {u, orientation.angle}, task.conditioning);
      return 1.0 / (value * value);
    };
    const double value = squared_kappa(z);
    if (value > 100.0) continue;
    ++compared;
    const auto function = squared_condition<double>(family, orientation, {u.x(), u.y()}, z);
    BOOST_TEST_REQUIRE(function.has_value());
    BOOST_TEST(function->value == value, boost::test_tools::tolerance(1e-8));
    BOOST_TEST(squared_condition_at(family, orientation, u, z) == value, boost::test_tools::tolerance(1e-8));
    Variables<Enclosure> point;
    for (std::size_t i = 0; i < 5; ++i) point[i] = Enclosure(z[i]);
    const auto enclosed =
        squared_condition<Enclosure>(family, orientation, {Enclosure(u.x()), Enclosure(u.y())}, point);
    BOOST_TEST_REQUIRE(enclosed.has_value());
    for (std::size_t i = 0; i < 5; ++i) {
      constexpr double step = 1e-5;
      Variables<double> after = z;
      Variables<double> before = z;
      after[i] += step;
      before[i] -= step;
      const double slope = (squared_kappa(after) - squared_kappa(before)) / (2.0 * step);
      BOOST_TEST(std::abs(function->gradient[i] - slope) < 1e-3 * (1.0 + value * value));
      BOOST_TEST(enclosed->gradient[i].lower() <= function->gradient[i] + 1e-9 * (1.0 + value * value));
      BOOST_TEST(enclosed->gradient[i].upper() >= function->gradient[i] - 1e-9 * (1.0 + value * value));
    }
  }
  BOOST_TEST(compared > test::scaled_minimum(500L));
}

/// Whatever leaves a box out is true of the designs in it: of those that reach the workspace, to samples of it, none
/// has a kappa^-1 above the bound; and where none reaches, none is found.
BOOST_AUTO_TEST_CASE(what_leaves_boxes_out_is_true_of_samples) {
  const SynthesisTask task = mo_task();
  const DesignFamily family(task, BaseJoints::in_line);
  DesignBox root{};
  root = {Interval{-1.0, 3.0}, {-1.0, 3.0}, {-0.75, 2.75}, {-0.25, 3.25}, {0.5, 2.6}};
  const BoxExaminer examiner(task, family, root);
  // Near a good design, in these variables.
  const Variables<double> good{-0.2088, 2.3135, 0.675, 0.3269, 0.9071};
  Random random(3);
  std::set<CertificateKind> kinds;
  for (long k = 0; k < test::scaled(800L); ++k) {
    DesignBox box{};
    const double size = std::pow(10.0, random(-4.0, -0.5));
    for (std::size_t i = 0; i < 5; ++i) {
      const double middle = good[i] + random(-1.0, 1.0) * 2.0 * size;
      box[i] = {middle - size * random(0.0, 1.0), middle + size * random(0.0, 1.0)};
    }
    const Examination found = examiner.examine(box, 0.5);
    kinds.insert(found.exclusion.kind);
    for (int sample = 0; sample < 3; ++sample) {
      const Variables<double> z = random_design(random, box);
      bool inside = true;
      for (std::size_t i = 0; i < 5; ++i) inside = inside && z[i] >= found.box[i].lower && z[i] <= found.box[i].upper;
      const bool alike = found.exclusion.kind == CertificateKind::legs_alike;
      if (alike) continue;
      const OutlineAssessment seen = assess_outline(task, family.to_design(z), 96);
      if (!inside || found.exclusion.bound == 0.0) {
        BOOST_TEST(seen.violation > 0.0);
      } else if (seen.violation == 0.0) {
        BOOST_TEST(seen.kappa_inverse <= found.exclusion.bound + 1e-12);
      }
    }
  }
  BOOST_TEST(kinds.contains(CertificateKind::limit));
  BOOST_TEST(kinds.contains(CertificateKind::combination));
}

BOOST_AUTO_TEST_CASE(the_best_design_of_a_workspace_is_proved) {
  GlobalOptions options;
  const GlobalOptimum found = prove_global_optimum(so_task(), options);
  BOOST_TEST((found.status == GlobalStatus::proved));
  BOOST_TEST(found.upper - found.lower <= options.gap);
  BOOST_TEST_REQUIRE(found.design.has_value());
  const DesignProof again = prove_design(so_task(), *found.design, {.margin_tolerance = 1e-9});
  BOOST_TEST((again.reaches == Verdict::proved));
  BOOST_TEST(again.kappa_inverse.upper >= found.lower);
  BOOST_TEST(assess(so_task(), *found.design).kappa_inverse >= found.lower - 1e-12);

  // With the platform turned round there is a twin.
  options.side = -1;
  options.known = found.lower;
  const GlobalOptimum twin = prove_global_optimum(so_task(), options);
  BOOST_TEST(std::abs(twin.upper - found.upper) < 2e-6);
}

/// What an independent prototype, written apart from this program, proved of the nine problems of Tables 5.3 to 5.5,
/// the prescribed workspaces as they were reconstructed then.
BOOST_AUTO_TEST_CASE(the_values_of_an_independent_prototype_are_met) {
  struct Case {
    Shape shape;
    double scale;
    std::vector<OrientationRange> orientations;
    int side;
    double lower;
    double upper;
    bool quick;
  };
  const Shape p1 = Superellipse{{1.34, 1.175}, 2.85};
  const Shape p2 = Ellipse{{1.75, 1.0}};
  const Shape p3 = QuarterEllipses{2.0, 2.0, 0.3, 1.14};
  const std::vector<OrientationRange> so = slices({0.0});
  const std::vector<OrientationRange> mo = slices({-5.0 * degree, 0.0, 5.0 * degree});
  const std::vector<OrientationRange> d{{-5.0 * degree, 5.0 * degree}};
  const std::vector<Case> cases{{p1, 1.0 / 5.0, so, 1, 0.916898929903, 0.91689895279, true},
                                {p2, 1.0 / 5.0, so, 1, 0.932301852729, 0.93230186724, true},
                                {p3, 1.0 / 7.0, so, 1, 0.943363430838, 0.94336345773, false},
                                {p1, 1.0 / 6.25, mo, 1, 0.902377188118, 0.90237720423, false},
                                {p2, 1.0 / 6.25, mo, 1, 0.917534036664, 0.91753405379, false},
                                {p3, 0.9 / 7.0, mo, 1, 0.916426190349, 0.91642620675, false},
                                {p1, 1.0 / 6.25, d, 1, 0.902377188118, 0.90237720423, false},
                                {p2, 1.0 / 6.25, d, 1, 0.917534036664, 0.91753405379, false},
                                {p3, 1.0 / 7.0, d, 1, 0.900209200476, 0.90020922093, false},
                                {p3, 0.9 / 7.0, mo, -1, 0.920754442502, 0.92075445770, false},
                                {p3, 1.0 / 7.0, d, -1, 0.906676130677, 0.90667614220, false}};
  constexpr double gap = 1e-6;
  constexpr Interval sizes{0.5, 2.6};
  for (const Case& one : cases) {
    if (test::few_samples && !one.quick) continue;
    const GlobalOptimum found = prove_global_optimum(task_of(one.shape, one.scale, one.orientations),
                                                     {.gap = gap, .side = one.side, .threads = 2, .sizes = sizes});
    BOOST_TEST((found.status == GlobalStatus::proved));
    BOOST_TEST(std::abs(found.lower - one.lower) < 1e-6);
    BOOST_TEST(found.upper >= one.lower);
    BOOST_TEST(found.upper <= one.upper + gap);
    BOOST_TEST(found.lower <= one.upper);
  }
}

BOOST_AUTO_TEST_CASE(threads_change_nothing) {
  GlobalOptions options;
  const GlobalOptimum one = prove_global_optimum(so_task(), options);
  options.threads = 3;
  const GlobalOptimum three = prove_global_optimum(so_task(), options);
  BOOST_TEST(one.upper == three.upper);
  BOOST_TEST(one.lower == three.lower);
  BOOST_TEST((*one.design == *three.design));
  BOOST_TEST(one.certificate.nodes.size() > 1'000U);
  BOOST_TEST((to_text(one.certificate) == to_text(three.certificate)));
}

BOOST_AUTO_TEST_CASE(a_search_that_is_cut_short_says_what_is_proved) {
  GlobalOptions options;
  double last = 1.0;
  for (const long boxes : {100L, 3'500L}) {
    options.max_boxes = boxes;
    const GlobalOptimum found = prove_global_optimum(so_task(), options);
    BOOST_TEST(found.upper >= 0.932301852729);
    BOOST_TEST(found.upper <= last);
    last = found.upper;
  }
  BOOST_TEST(last < 0.99);
  long polled = 0;
  options.stop = [&] { return ++polled > 3; };
  BOOST_TEST((prove_global_optimum(so_task(), options).status == GlobalStatus::stopped));
}

BOOST_AUTO_TEST_CASE(a_workspace_out_of_reach_is_proved_to_be) {
  const SynthesisTask task = task_of(Circle{2.5}, 1.0, slices({0.0}));
  const GlobalOptimum found = prove_global_optimum(task);
  BOOST_TEST((found.status == GlobalStatus::unreachable));
  BOOST_TEST(!found.design.has_value());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_proved_is_rejected) {
  SynthesisTask task = so_task();
  task.conditioning = {};
  BOOST_CHECK_THROW(prove_global_optimum(task), std::invalid_argument);
  task = so_task();
  task.designs = DesignSpace(task.designs.origin(), {"x"}, Eigen::MatrixXd::Ones(12, 1), Eigen::MatrixXd::Zero(6, 1));
  BOOST_CHECK_THROW(prove_global_optimum(task), std::invalid_argument);
  BOOST_CHECK_THROW(prove_global_optimum(so_task(), {.gap = 0.0}), std::invalid_argument);
  BOOST_CHECK_THROW(prove_global_optimum(so_task(), {.side = 0}), std::invalid_argument);
}

}  // namespace
