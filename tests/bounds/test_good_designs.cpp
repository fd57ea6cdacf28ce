// The enclosure of all designs that are better than a value, against designs found by chance.

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "reprise/bounds/good_designs.hpp"
#include "reprise/synthesis/semi_infinite.hpp"
#include "sample_count.hpp"

namespace {

using namespace reprise;

/// The reconstructed P2 of Table 5.3, symmetric about both lines through its centre; the legs' limits are narrower by a
/// margin.
SynthesisTask symmetric_task(double margin = 0.0) {
  return {PrescribedWorkspace("prescribed", Ellipse{{1.75, 1.0}}, {{1.0, 1.5}, 0.2, 0.0}),
          slices({0.0}),
          DesignSpace::collinear({Interval{std::sqrt(2.0) + margin, 2.0 - margin},
                                  {std::sqrt(2.0) + margin, 2.0 - margin},
                                  {1.0 + margin, std::sqrt(3.0) - margin}}),
          {Normalisation::printed, {}}};
}

/// The smallest kappa^-1 of its best design, as independent methods find it.
constexpr double best_value = 0.9323018;

using Variables = std::array<double, 5>;

Variables variables_of(const Eigen::VectorXd& d) { return {d[0] + d[4], d[2] + d[4], d[3] - d[4], d[1], d[4]}; }

bool holds(const GoodDesigns& good, const Variables& z) {
  return std::any_of(good.boxes.begin(), good.boxes.end(), [&](const GoodBox& box) {
    return std::equal(z.begin(), z.end(), box.variables.begin(),
                      [](double x, const Interval& range) { return x >= range.lower && x <= range.upper; });
  });
}

/// A design or one of its images: legs 1 and 2 changed, mirrored in y = 1.5, in x = 1, or several of these.
bool holds_image(const GoodDesigns& good, const Variables& z) {
  for (const bool changed : {false, true}) {
    for (const bool in_y : {false, true}) {
      for (const bool in_x : {false, true}) {
        Variables image = z;
        if (changed) std::swap(image[0], image[1]);
        if (in_y) image[3] = 3.0 - image[3];
        if (in_x) {
          for (std::size_t i = 0; i < 3; ++i) image[i] = 2.0 - image[i];
        }
        if (holds(good, image)) return true;
      }
    }
  }
  return false;
}

BOOST_AUTO_TEST_CASE(every_good_design_is_in_a_box) {
  const SynthesisTask task = symmetric_task();
  constexpr double value = best_value - 1e-3;
  const GoodDesigns good = enclose_good_designs(task, value, {.resolution = 0.02, .threads = 2});
  BOOST_TEST_REQUIRE(good.complete);
  BOOST_TEST(good.boxes.size() < 200U);
  // The same by what a proof of the bound leaves.
  const GlobalOptimum proved = prove_global_optimum(task, {.gap = 1e-4});
  const GoodDesigns after_proof = enclose_good_designs(task, value, {.resolution = 0.02, .proof = &proved.certificate});
  BOOST_TEST_REQUIRE(after_proof.complete);
  BOOST_TEST(after_proof.examined < good.examined);
  // Around designs that are the best within narrower limits.
  constexpr std::array<double, 3> margins{1e-5, 1e-4, 5e-4};
  std::array<Eigen::VectorXd, 3> inside;
  for (std::size_t k = 0; k < margins.size(); ++k) {
    inside[k] = prove_global_optimum(symmetric_task(margins[k]), {.gap = 1e-4}).design.value();
  }
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  long found = 0;
  for (long k = 0; k < test::scaled(600L); ++k) {
    const std::size_t from = static_cast<std::size_t>(k) % margins.size();
    Eigen::VectorXd d = inside[from];
    for (double& one : d) one += margins[from] * std::uniform_real_distribution(0.0, 1.0)(engine) * normal(engine);
    const OutlineAssessment seen = assess_outline(task, d, 96);
    if (seen.violation > 0.0 || seen.kappa_inverse <= value) continue;
    ++found;
    BOOST_TEST(holds_image(good, variables_of(d)));
    BOOST_TEST(holds_image(after_proof, variables_of(d)));
  }
  BOOST_TEST(found > test::scaled_minimum(100L));
}

BOOST_AUTO_TEST_CASE(hulls_hold_their_boxes_and_groups_do_not_touch) {
  const GoodDesigns good = enclose_good_designs(symmetric_task(), best_value - 1e-3, {.resolution = 0.02});
  BOOST_TEST_REQUIRE(good.complete);
  std::size_t last = 0;
  for (const GoodBox& box : good.boxes) {
    BOOST_TEST_REQUIRE(box.group < good.hulls.size());
    BOOST_TEST(box.group >= last);
    last = box.group;
    for (std::size_t i = 0; i < 5; ++i) {
      BOOST_TEST(box.variables[i].upper - box.variables[i].lower <= 0.02);
      BOOST_TEST(box.design[i].lower >= good.hulls[box.group][i].lower);
      BOOST_TEST(box.design[i].upper <= good.hulls[box.group][i].upper);
    }
    for (const GoodBox& other : good.boxes) {
      bool touch = true;
      for (std::size_t i = 0; i < 5; ++i) {
        touch = touch && box.variables[i].lower <= other.variables[i].upper &&
                other.variables[i].lower <= box.variables[i].upper;
      }
      if (touch) BOOST_TEST(box.group == other.group);
    }
  }
  BOOST_TEST(last + 1 == good.hulls.size());
}

BOOST_AUTO_TEST_CASE(above_the_best_there_is_nothing) {
  const GoodDesigns good = enclose_good_designs(symmetric_task(), best_value + 1e-4, {.resolution = 1e-4});
  BOOST_TEST(good.complete);
  BOOST_TEST(good.boxes.empty());
  BOOST_TEST(good.hulls.empty());
}

BOOST_AUTO_TEST_CASE(a_search_that_is_cut_short_proves_nothing) {
  const GoodDesigns good = enclose_good_designs(symmetric_task(), best_value - 1e-3, {.max_boxes = 500});
  BOOST_TEST(!good.complete);
  BOOST_TEST(good.boxes.empty());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_enclosed_is_rejected) {
  const SynthesisTask task = symmetric_task();
  BOOST_CHECK_THROW(enclose_good_designs(task, 1.0), std::invalid_argument);
  BOOST_CHECK_THROW(enclose_good_designs(task, 0.1), std::invalid_argument);
  BOOST_CHECK_THROW(enclose_good_designs(task, 0.9, {.resolution = 0.0}), std::invalid_argument);
  BOOST_CHECK_THROW(enclose_good_designs(task, 0.9, {.side = 2}), std::invalid_argument);
  BOOST_CHECK_THROW(enclose_good_designs(task, 0.9, {.max_boxes = 0}), std::invalid_argument);
  const GlobalOptimum other = prove_global_optimum(task, {.gap = 0.05, .side = -1});
  BOOST_CHECK_THROW(enclose_good_designs(task, 0.9, {.proof = &other.certificate}), std::invalid_argument);
}

}  // namespace
