// The reconstruction of outlines from printed rows, tried on rows that are made from a known outline.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "reconstruction/evidence.hpp"
#include "reconstruction/outline_families.hpp"
#include "reconstruction/outline_fit.hpp"
#include "reprise/base/constants.hpp"
#include "reprise/optimizers/nlopt.hpp"

namespace {

using namespace reprise;
using namespace reprise::experiments;
using boost::test_tools::tolerance;

constexpr int directions = 90;

std::vector<double> equal_angles(int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(2.0 * pi * i / count);
  return angles;
}

/// A number printed to many digits.
PrintedNumber exactly(double value, double half_unit) { return {"", value, half_unit}; }

/// What is printed for a workspace, with the values of another outline: its size in each table is such that it touches
/// the workspace of the row's design, and its values are known to half a unit of the third decimal.
struct MadeUp {
  std::vector<PublishedRow> rows;
  std::vector<double> divisors;

  std::vector<std::shared_ptr<const RowModel>> models() const {
    std::vector<std::shared_ptr<const RowModel>> result;
    for (const PublishedRow& row : rows) result.push_back(std::make_shared<RowModel>(row));
    return result;
  }
};

MadeUp make_up(const std::string& workspace, const Shape& shape) {
  MadeUp made;
  for (PublishedRow row : read_published_rows()) {
    if (row.workspace != workspace) continue;
    const RowModel model(row);
    const auto predict = [&](double divisor) {
      return model.predict({"known", shape, {outline_centre(), 1.0 / divisor, 0.0}}, equal_angles(directions));
    };
    double too_large = 3.0;
    double small_enough = 20.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (too_large + small_enough);
      (predict(middle).clearance >= 0.0 ? small_enough : too_large) = middle;
    }
    const Prediction prediction = predict(small_enough);
    row.f_d0 = exactly(prediction.f_d0, 5e-4);
    row.f_star = exactly(prediction.f_star, 5e-4);
    made.rows.push_back(row);
    made.divisors.push_back(small_enough);
  }
  return made;
}

BOOST_AUTO_TEST_SUITE(reconstruction)

BOOST_AUTO_TEST_CASE(printed_numbers_know_their_rounding) {
  const auto check = [](const char* text, double value, double half_unit) {
    const PrintedNumber number = printed_number(text);
    BOOST_TEST(number.text == text);
    BOOST_TEST(number.value == value, tolerance(1e-15));
    BOOST_TEST(number.half_unit == half_unit, tolerance(1e-12));
  };
  check("0.759", 0.759, 5e-4);
  check("-1.111", -1.111, 5e-4);
  check("0.8500", 0.85, 5e-5);
  check("0.2E-5", 2e-6, 5e-7);
  check("0.4E-9", 4e-10, 5e-11);
  check("7", 7.0, 0.5);
  check("-1.0340", -1.034, 5e-5);
  for (const char* text : {"", "abc", "0.7x", "0.7 "}) {
    BOOST_CHECK_THROW(static_cast<void>(printed_number(text)), std::runtime_error);
  }
}

BOOST_AUTO_TEST_CASE(rows_are_those_of_the_tables) {
  const std::vector<PublishedRow> rows = read_published_rows();
  BOOST_TEST(rows.size() == 9U);
  for (const PublishedRow& row : rows) {
    BOOST_TEST(row.design.size() == 5);
    BOOST_TEST(row.rounding.minCoeff() >= 5e-5 * (1.0 - 1e-12));
    BOOST_TEST(row.rounding.maxCoeff() <= 5e-4 * (1.0 + 1e-12));
    BOOST_TEST(row.orientations.size() == (row.synthesis == "SO" ? 1U : row.synthesis == "MO" ? 3U : 2U));
    BOOST_TEST(row.dextrous_range.has_value() == (row.synthesis == "D"));
  }
  const PublishedRow changed = with_y_c(rows[0], 0.3);
  BOOST_TEST(changed.design[1] == 0.3);
  BOOST_TEST(changed.design[0] == rows[0].design[0]);
  BOOST_TEST(changed.reading != rows[0].reading);
}

// At the wrong size the clearance of a circle about O' is the distance of O' from the nearest limit, less its radius.
BOOST_AUTO_TEST_CASE(clearance_and_miss_of_a_circle) {
  const RowModel model(read_published_rows()[1]);
  const std::vector<double> angles = equal_angles(720);
  const auto circle = [](double radius) { return PrescribedWorkspace("c", Circle{radius}, {outline_centre()}); };
  const double reach = model.predict(circle(1e-6), angles).clearance + 1e-6;
  for (const double radius : {0.5 * reach, 1.2 * reach}) {
    const Prediction prediction = model.predict(circle(radius), angles);
    BOOST_TEST(prediction.clearance == reach - radius, tolerance(1e-3));
    const Miss miss = model.miss(circle(radius), angles, false);
    BOOST_TEST((miss.area > 0.0) == (radius > reach));
    BOOST_TEST(miss.polar_clearance == prediction.clearance, tolerance(1e-2));
    BOOST_TEST(model.miss(circle(radius), angles, true).area <= miss.area);
  }
  // Sticking out by less than the allowance is no miss.
  const double little = reach + 0.9 * model.length_change();
  BOOST_TEST(model.miss(circle(little), angles, false).area > 0.0);
  BOOST_TEST(model.miss(circle(little), angles, true).area == 0.0);
}

BOOST_AUTO_TEST_CASE(known_outlines_come_back) {
  const NloptSolver slsqp;
  const auto check = [&](const std::string& workspace, const Eigen::VectorXd& truth) {
    const OutlineFamily family = main_family(workspace);
    const Shape shape = family.shape(truth);
    BOOST_TEST(main_parameters(shape) == truth, boost::test_tools::per_element());
    const MadeUp made = make_up(workspace, shape);
    const OutlineFit fit(made.models(), family, {"known", made.divisors, false}, directions);
    // The truth itself has no residual and is compatible.
    const FittedOutline known = fit.judge(truth);
    BOOST_TEST(known.sum_of_squares < 1e-15);
    BOOST_TEST(known.excess < 1e-6);
    // The fit explains the values to a small part of their rounding; what the values do not tell apart, it cannot.
    const FittedOutline found = fit.least_squares(slsqp, 2);
    BOOST_TEST(found.largest_residual < 0.3);
    const FittedOutline nearest = fit.nearest(slsqp, found);
    BOOST_TEST(nearest.excess <= found.excess);
    BOOST_TEST(nearest.excess <= 1.0);
    // Every outline at the ends is compatible, and the truth lies between them.
    const std::vector<Extent> extents = fit.extents(slsqp, nearest);
    BOOST_REQUIRE(extents.size() == static_cast<std::size_t>(truth.size()));
    for (Eigen::Index j = 0; j < truth.size(); ++j) {
      const Extent& extent = extents[static_cast<std::size_t>(j)];
      BOOST_TEST(fit.judge(extent.least).excess <= 1.0 + 1e-5);
      BOOST_TEST(fit.judge(extent.most).excess <= 1.0 + 1e-5);
      BOOST_TEST(extent.least[j] <= truth[j] + 1e-9);
      BOOST_TEST(truth[j] <= extent.most[j] + 1e-9);
    }
  };
  check("P2", Eigen::Vector3d(1.6, 1.1, 2.3));
  check("P3", Eigen::Vector4d(1.8, 1.9, 0.5, 1.2));
}

BOOST_AUTO_TEST_CASE(sizes_come_back_too) {
  const Shape shape = Superellipse{{1.6, 1.1}, 2.3};
  const MadeUp made = make_up("P2", shape);
  const std::vector<double> starts{made.divisors[0], 1.03 * made.divisors[1], 0.98 * made.divisors[2]};
  const OutlineFit fit(made.models(), main_family("P2"), {"fitted", starts, true}, directions);
  BOOST_TEST(fit.names().size() == 5U);
  const FittedOutline found = fit.least_squares(NloptSolver(), 1);
  BOOST_TEST(found.largest_residual < 0.3);
  for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(fit.divisors(found.x)[i] == made.divisors[i], tolerance(2e-2));
  // A wrong size is found out.
  const OutlineFit wrong(made.models(), main_family("P2"), {"wrong", std::vector<double>(3, made.divisors[0]), false},
                         directions);
  const FittedOutline nearest = wrong.nearest(NloptSolver(), wrong.judge(main_family("P2").start));
  BOOST_TEST(nearest.excess > 2.0);
  BOOST_TEST(wrong.extents(NloptSolver(), nearest).empty());
}

BOOST_AUTO_TEST_CASE(evidence_allows_the_known_sizes) {
  const MadeUp made = make_up("P2", Superellipse{{1.6, 1.1}, 2.3});
  const Evidence evidence(made.rows, {{60, 40}, 1e-3});
  const std::map<std::string, double> divisors{
      {"5.3", made.divisors[0]}, {"5.4", made.divisors[1]}, {"5.5", made.divisors[2]}};
  BOOST_TEST(evidence.common("P2", "as printed", divisors).compatible);
  const Table sizes = evidence.compare_sizes({{"P2", divisors}});
  BOOST_TEST(sizes.rows() == 3U);
  for (std::size_t i = 0; i < sizes.rows(); ++i) BOOST_TEST(sizes.text(i, "data_compatible") == "yes");
  const Table regions = evidence.describe_regions();
  for (std::size_t i = 0; i < regions.rows(); ++i) {
    BOOST_TEST(regions.text(i, "compatible") == "yes");
    BOOST_TEST(regions.number(i, "lowest_f_d0") <= made.rows[i].f_d0.value + 5e-4);
    BOOST_TEST(regions.number(i, "lowest_f_d0_allowed") <= regions.number(i, "lowest_f_d0"));
  }
}

BOOST_AUTO_TEST_CASE(an_impossible_row_is_found_out_and_mended) {
  MadeUp made = make_up("P2", Superellipse{{1.6, 1.1}, 2.3});
  // A printed f(d^0) that begins with a wrong digit.
  PublishedRow& row = made.rows[0];
  const int thousandths = static_cast<int>(std::lround(1000.0 * row.f_d0.value));
  const int wrong = thousandths % 1000 / 100 == 5 ? thousandths - 100 : 500 + thousandths % 100;
  row.f_d0 = printed_number("0." + std::to_string(wrong));
  row.f_star = printed_number("0." + std::to_string(static_cast<int>(std::lround(1000.0 * row.f_star.value))));
  const Evidence evidence(made.rows, {{60, 40}, 1e-3});
  BOOST_TEST(evidence.describe_regions().text(0, "compatible") == "no");
  const Table changes = evidence.change_digits("5.3", "P2");
  bool mended = false;
  for (std::size_t i = 0; i < changes.rows(); ++i) {
    mended = mended ||
             (changes.text(i, "quantity") == "f_d0" && std::lround(1000.0 * changes.number(i, "lower")) == thousandths);
  }
  BOOST_TEST(mended);
}

BOOST_AUTO_TEST_CASE(families_are_closed_outlines_about_the_centre) {
  for (const char* workspace : {"P1", "P2", "P3"}) {
    std::vector<OutlineFamily> families = other_families(workspace);
    families.push_back(main_family(workspace));
    for (const OutlineFamily& family : families) {
      BOOST_TEST(family.parameters.size() == static_cast<std::size_t>(family.start.size()));
      for (const auto* bound : {&family.lower, &family.upper}) BOOST_TEST(bound->size() == family.start.size());
      BOOST_TEST((family.lower.array() < family.start.array()).all());
      BOOST_TEST((family.start.array() < family.upper.array()).all());
      for (const auto* x : {&family.lower, &family.start, &family.upper}) {
        const PrescribedWorkspace outline(family.name, family.shape(*x));
        for (const double beta : equal_angles(36)) BOOST_TEST(outline.radius(beta) > 0.0);
      }
    }
  }
  BOOST_CHECK_THROW(static_cast<void>(main_family("P4")), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
