#include <Eigen/Geometry>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "reprise/base/constants.hpp"
#include "reprise/bounds/enclosure.hpp"
#include "reprise/kinematics/coordinates.hpp"
#include "reprise/kinematics/kappa_inverse_formula.hpp"
#include "synthesis/samples.hpp"

namespace {

using namespace reprise;
using boost::test_tools::tolerance;

const Conditioning printed{Normalisation::printed, {}};

/// A leg that can have any length.
Leg free_leg(const Eigen::Vector2d& base_joint, const Eigen::Vector2d& platform_joint) {
  return {base_joint, platform_joint, {0.0, 100.0}, {}, {}};
}

/// Two, three and four legs in no special position, and the thesis's family.
std::vector<Manipulator> manipulators() {
  return {{"two", {free_leg({-1.0, 0.1}, {0.1, 0.2}), free_leg({1.2, -0.2}, {-0.3, 0.1})}},
          samples::general_manipulator(),
          {"four",
           {free_leg({-1.1, 0.1}, {-0.7, -0.2}), free_leg({1.2, -0.2}, {0.1, 0.6}), free_leg({2.1, 0.3}, {0.8, -0.1}),
            free_leg({0.4, 2.6}, {0.3, 0.5})}},
          make_manipulator({-1.0, 0.0, 1.0, 2.0, 1.0}, samples::thesis_lengths())};
}

std::vector<Conditioning> conditionings() {
  return {printed, {Normalisation::homogeneous, {}}, {Normalisation::homogeneous, 0.4}, {Normalisation::printed, 2.5}};
}

/// An equilateral platform within an equilateral base: singular on the circle through the points q_i = c_i - R p_i, at
/// which a leg has length zero, and nowhere else unless phi is 0, at which it is singular everywhere.
Manipulator equilateral(double base, double platform) {
  std::vector<Leg> legs;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d direction(std::cos(2.0 * pi * i / 3.0), std::sin(2.0 * pi * i / 3.0));
    legs.push_back(free_leg(base * direction, platform * direction));
  }
  return {"equilateral", legs};
}

bool holds(const Interval& bounds, double value, double rounding = 0.0) {
  return value >= bounds.lower - rounding && value <= bounds.upper + rounding;
}

double width(const Interval& interval) { return interval.upper - interval.lower; }

class Random {
 public:
  double between(double lower, double upper) { return std::uniform_real_distribution(lower, upper)(engine_); }
  double within(const Interval& interval) { return between(interval.lower, interval.upper); }
  Interval around(double middle, double half_width) { return {middle - half_width, middle + half_width}; }

 private:
  std::mt19937 engine_{20240511};
};

/// The smallest value of a function over a sample of poses: of the region, or of its outline alone.
template <class Function>
double sampled_minimum(const PrescribedWorkspace& prescribed, const OrientationRange& range, bool outline_only,
                       const Function& function, int steps = 10) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const double beta : prescribed.angles(8 * steps)) {
    const Eigen::Vector2d spoke = prescribed.point(beta) - prescribed.centre();
    for (int j = outline_only ? steps : 0; j <= steps; ++j) {
      const Eigen::Vector2d u = prescribed.centre() + static_cast<double>(j) / steps * spoke;
      for (int k = 0; k <= (range.lower == range.upper ? 0 : steps); ++k) {
        smallest = std::min(smallest, function(Pose{u, range.lower + width(range) * k / steps}));
      }
    }
  }
  return smallest;
}

/// kappa^-1 in the thesis's normalisation.
auto printed_kappa_inverse(const Manipulator& manipulator) {
  return [&manipulator](const Pose& pose) { return kappa_inverse(manipulator, pose, printed); };
}

BOOST_AUTO_TEST_SUITE(enclosure)

BOOST_AUTO_TEST_CASE(bounds_over_a_box_hold_values_and_derivatives_at_its_poses) {
  Random random;
  int useful = 0;
  for (const Manipulator& manipulator : manipulators()) {
    const Eigen::MatrixXd pose_directions = Eigen::MatrixXd::Identity(coordinate_count(manipulator.size()), 3);
    for (const Conditioning& conditioning : conditionings()) {
      for (int i = 0; i < 25; ++i) {
        const double size = std::pow(10.0, random.between(-6.0, -0.5));
        const PoseBox box{random.around(random.between(-0.5, 2.0), size), random.around(random.between(0.5, 2.5), size),
                          random.around(random.between(-3.0, 3.0), size)};
        const KappaInverseBounds bounds = bound_kappa_inverse(manipulator, box, conditioning);
        BOOST_TEST(bounds.value.lower >= 0.0);
        BOOST_TEST(bounds.value.upper <= 1.0);
        if (width(bounds.value) < 0.1) ++useful;
        for (int k = 0; k < 10; ++k) {
          const Pose pose{{random.within(box.x), random.within(box.y)}, random.within(box.orientation)};
          Eigen::Vector3d gradient;
          const double value = kappa_inverse(manipulator, pose, conditioning, pose_directions, gradient);
          // The sample, not the bounds, has a rounding error to be allowed for.
          BOOST_TEST(holds(bounds.value, value, 1e-14));
          BOOST_TEST(holds(bounds.x, gradient.x(), 1e-12));
          BOOST_TEST(holds(bounds.y, gradient.y(), 1e-12));
          BOOST_TEST(holds(bounds.orientation, gradient.z(), 1e-12));
        }
      }
    }
  }
  BOOST_TEST(useful > 200);
}

BOOST_AUTO_TEST_CASE(bounds_at_a_pose_hold_the_value_of_a_finer_arithmetic) {
  // In extended precision the value is known to some 1e-18, far below the width of the bounds.
  static_assert(std::numeric_limits<long double>::digits >= 64);
  Random random;
  for (const Manipulator& manipulator : manipulators()) {
    if (manipulator.size() == 2) continue;  // has no normalisation
    for (int i = 0; i < 200; ++i) {
      const double x = random.between(-0.5, 2.0);
      const double y = random.between(0.5, 2.5);
      const double phi = random.between(-3.0, 3.0);
      const double characteristic = random.between(0.1, 3.0);
      const KappaInverseBounds bounds =
          bound_kappa_inverse(manipulator, {{x, x}, {y, y}, {phi, phi}}, {Normalisation::printed, characteristic});
      JacobianRows<long double> rows(manipulator.size());
      for (std::size_t leg = 0; leg < manipulator.size(); ++leg) {
        using Vector = Eigen::Matrix<long double, 2, 1>;
        const Vector arm =
            Eigen::Rotation2D<long double>(phi) * manipulator.leg(leg).platform_joint.cast<long double>();
        const Vector direction =
            (Vector(x, y) + arm - manipulator.leg(leg).base_joint.cast<long double>()).normalized();
        rows[leg] = {direction.x(), direction.y(),
                     characteristic * (arm.x() * direction.y() - arm.y() * direction.x())};
      }
      long double value = 0.0L;
      BOOST_TEST(kappa_inverse_of_rows(manipulator.size(), rows, value));
      BOOST_TEST((value >= bounds.value.lower && value <= bounds.value.upper));
    }
  }
}

BOOST_AUTO_TEST_CASE(bounds_at_a_pose_are_sharp) {
  for (const Manipulator& manipulator : manipulators()) {
    for (const Conditioning& conditioning : conditionings()) {
      const Pose pose{{0.7, 1.6}, 0.2};
      const KappaInverseBounds bounds =
          bound_kappa_inverse(manipulator, {{0.7, 0.7}, {1.6, 1.6}, {0.2, 0.2}}, conditioning);
      // More than three legs are reduced to a triangular factor first, whose roundings come on top.
      const double roundings = manipulator.size() > 3 ? 3.0 : 1.0;
      BOOST_TEST(width(bounds.value) < roundings * 1e-13);
      BOOST_TEST(width(bounds.x) < roundings * 1e-12);
      BOOST_TEST(holds(bounds.value, kappa_inverse(manipulator, pose, conditioning), 1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE(halving_a_box_quarters_the_excess_of_values_and_halves_that_of_derivatives) {
  for (const Manipulator& manipulator : manipulators()) {
    const Eigen::MatrixXd pose_directions = Eigen::MatrixXd::Identity(coordinate_count(manipulator.size()), 3);
    // What the bounds are wider than the range of a sample that holds the corners of the box.
    const auto excess = [&](double half) -> Eigen::Vector2d {
      const PoseBox box{{0.7 - half, 0.7 + half}, {1.6 - half, 1.6 + half}, {0.2 - half, 0.2 + half}};
      Interval value{1.0, 0.0};
      Interval slope{1e9, -1e9};
      constexpr int steps = 8;
      for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
          for (int k = 0; k <= steps; ++k) {
            const auto at = [&](const OrientationRange& range, int step) {
              return range.lower + width(range) * step / steps;
            };
            Eigen::Vector3d gradient;
            const double f = kappa_inverse(manipulator, {{at(box.x, i), at(box.y, j)}, at(box.orientation, k)}, printed,
                                           pose_directions, gradient);
            value = {std::min(value.lower, f), std::max(value.upper, f)};
            slope = {std::min(slope.lower, gradient.x()), std::max(slope.upper, gradient.x())};
          }
        }
      }
      const KappaInverseBounds bounds = bound_kappa_inverse(manipulator, box, printed);
      return {width(bounds.value) - width(value), width(bounds.x) - width(slope)};
    };
    for (const double half : {0.01, 0.005}) {
      const Eigen::Array2d ratio = excess(half).array() / excess(0.5 * half).array();
      BOOST_TEST(ratio[0] > 3.5);
      BOOST_TEST(ratio[1] > 1.8);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_isotropic_pose_has_one_among_its_bounds) {
  // Two legs at a right angle.
  const Manipulator two("two", {free_leg({-1.0, 0.0}, {0.0, 0.0}), free_leg({1.0, 0.0}, {0.0, 0.0})});
  const KappaInverseBounds bounds = bound_kappa_inverse(two, {{-0.01, 0.01}, {0.99, 1.01}, {0.0, 0.0}});
  BOOST_TEST(bounds.value.upper == 1.0);
  BOOST_TEST(bounds.value.lower > 0.999);
  BOOST_TEST(holds(bounds.x, 0.0));
  BOOST_TEST(holds(bounds.y, 0.0));
}

BOOST_AUTO_TEST_CASE(two_legs_over_a_disc_in_closed_form) {
  // kappa^-1 is the sine of the angle at P between the legs, constant on circles through both base joints (-a, 0), (a,
  // 0). Over a disc above the circle of radius a it is smallest where the largest of these circles touches the disc: at
  // its top, tan(angle / 2) = a / height.
  const double a = 0.8;
  const Manipulator two("two", {free_leg({-a, 0.0}, {0.0, 0.0}), free_leg({a, 0.0}, {0.0, 0.0})});
  const PrescribedWorkspace disc("disc", Circle{0.5}, {{0.0, 1.6}, 1.0, 0.3});
  const double top = 2.1;
  const double exact = 2.0 * a * top / (a * a + top * top);
  for (const double precision : {1e-3, 1e-6, 1e-10}) {
    const MinimumEnclosure minimum = enclose_minimum(two, disc, {-0.1, 0.4}, {}, {.tolerance = precision});
    BOOST_TEST(minimum.reached);
    BOOST_TEST(minimum.upper - minimum.lower <= precision);
    BOOST_TEST(holds({minimum.lower, minimum.upper}, exact, 1e-15));
  }
  const MinimumEnclosure minimum = enclose_minimum(two, disc, {0.0, 0.0}, {}, {.tolerance = 1e-10});
  BOOST_TEST((minimum.witness->position - Eigen::Vector2d(0.0, top)).norm() < 1e-4);
  // An exact statement, proved however coarse the bounds are.
  for (const double precision : {1e-1, 1e-3, 1e-6}) {
    BOOST_TEST((check_minimum_on_outline(two, disc, {0.0, 0.0}, {}, {precision}).verdict == Verdict::proved));
  }
}

BOOST_AUTO_TEST_CASE(enclosures_agree_with_samples_for_every_shape) {
  const Placement placement{{1.0, 1.5}, 0.2, 0.4};
  const std::vector<PrescribedWorkspace> workspaces{
      {"superellipse", Superellipse{{1.42, 1.185}, 2.5}, placement},
      {"ellipse", Ellipse{{1.75, 1.0}}, placement},
      {"quarters", QuarterEllipses{2.0, 2.0, 0.3, 1.14}, placement},
      {"circle", Circle{1.2}, placement},
      {"rectangle", Rectangle{2.0, 1.5}, placement},
      {"star", Superellipse{{1.4, 1.4}, 0.6}, placement},
      {"polygon", Polygon{{{1.5, 0.2}, {-0.3, 1.2}, {-1.0, -1.0}, {0.2, -0.3}}}, placement},
      {"table", PolarTable{{0.3, 2.0, 4.0}, {1.0, 1.7, 0.6}}, placement}};
  const Manipulator manipulator = make_manipulator({-1.1, 0.26, 1.28, 1.97, 0.92}, samples::thesis_lengths());
  for (const PrescribedWorkspace& prescribed : workspaces) {
    for (const Interval& range : {Interval{0.0, 0.0}, Interval{-0.1, 0.15}}) {
      const MinimumEnclosure minimum = enclose_minimum(manipulator, prescribed, range, printed);
      const double sampled = sampled_minimum(prescribed, range, false, printed_kappa_inverse(manipulator));
      BOOST_TEST_CONTEXT(prescribed.name()) {
        BOOST_TEST(minimum.reached);
        BOOST_TEST(minimum.lower <= sampled);
        BOOST_TEST(sampled - minimum.upper < 5e-3);
        const double at_witness = kappa_inverse(manipulator, *minimum.witness, printed);
        BOOST_TEST(at_witness <= minimum.upper + 1e-14);
        BOOST_TEST(at_witness >= minimum.lower);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(containment)

/// One leg from c whose joint at the platform is P itself.
Manipulator one_leg(const Eigen::Vector2d& c, const Interval& length) {
  return {"one", {Leg{c, {0.0, 0.0}, length, {}, {}}}};
}

BOOST_AUTO_TEST_CASE(shapes_in_an_annulus_in_closed_form) {
  // The smallest and the largest distance from a point to the region.
  const Eigen::Vector2d c(0.7, -0.2);
  const Interval length{0.5, 4.0};
  const auto check = [&](const PrescribedWorkspace& prescribed, double nearest, double farthest) {
    const Containment result = prove_containment(one_leg(c, length), prescribed, {0.3, 0.3});
    BOOST_TEST_CONTEXT(prescribed.name()) {
      BOOST_TEST(result.limits.size() == 2U);
      const auto& [shortest, longest] = std::pair(result.limits[0].margin, result.limits[1].margin);
      BOOST_TEST((shortest.reached && longest.reached));
      BOOST_TEST(holds({shortest.lower, shortest.upper}, nearest - length.lower, 1e-14));
      BOOST_TEST(holds({longest.lower, longest.upper}, length.upper - farthest, 1e-14));
      const bool contained = nearest >= length.lower && farthest <= length.upper;
      BOOST_TEST((result.verdict == (contained ? Verdict::proved : Verdict::refuted)));
    }
  };
  const Eigen::Vector2d away = Eigen::Rotation2Dd(0.4) * Eigen::Vector2d(2.0, 0.0);
  const Placement placed{c + away, 0.5, 0.4};  // c lies on the shape's own x-axis, at -2
  check({"disc", Circle{2.0}, placed}, 1.0, 3.0);
  check({"large disc", Circle{4.2}, placed}, 0.0, 4.1);
  check({"ellipse", Ellipse{{2.0, 0.6}}, placed}, 1.0, 3.0);
  check({"superellipse", Superellipse{{2.0, 0.6}, 1.7}, placed}, 1.0, 3.0);
  check({"quarters", QuarterEllipses{1.0, 0.3, 2.2, 0.2}, placed}, 0.9, 2.5);
  check({"rectangle", Rectangle{2.0, 1.0}, placed}, 1.5, std::hypot(2.5, 0.25));
  check({"triangle", Polygon{{{3.0, 1.0}, {-1.0, 0.0}, {3.0, -1.0}}}, placed}, 1.5, std::hypot(3.5, 0.5));
  check({"diamond", Superellipse{{2.0, 2.0}, 1.0}, placed}, 1.0, 3.0);
  check({"star", Superellipse{{2.0, 2.0}, 0.5}, placed}, 1.0, 3.0);
  check({"table", PolarTable{{-1.0, 0.5, 3.0}, {2.0, 2.0, 2.0}}, placed}, 1.0, 3.0);
  // From its own centre a superellipse of exponent 4 reaches 2^(1/4) along the diagonal, with P 0.5 beyond.
  check({"fat", Superellipse{{1.0, 1.0}, 4.0}, {c, 2.0, 0.4}}, 0.0, 2.0 * std::pow(2.0, 0.25));
}

BOOST_AUTO_TEST_CASE(an_extreme_orientation_between_the_ends_is_found) {
  // |u + R(phi) p| is largest where R(phi) p points along u: at phi = 0, within the range.
  const Manipulator one("one", {Leg{{0.0, 0.0}, {0.6, 0.0}, {1.0, 3.0}, {}, {}}});
  const PrescribedWorkspace disc("disc", Circle{0.3}, {{2.0, 0.0}, 1.0, 0.0});
  const Containment result = prove_containment(one, disc, {-0.5, 0.8});
  const MinimumEnclosure& longest = result.limits[1].margin;
  BOOST_TEST(holds({longest.lower, longest.upper}, 3.0 - 2.9, 1e-15));
  BOOST_TEST((result.verdict == Verdict::proved));
}

BOOST_AUTO_TEST_CASE(a_planted_violation_is_refuted_and_allowed_for) {
  const PrescribedWorkspace disc("disc", Circle{0.5}, {{2.0, 1.0}, 1.0, 0.0});
  const double distance = std::sqrt(5.0);
  for (const double planted : {1e-5, 1e-7}) {
    for (const bool longest : {true, false}) {
      const Interval length =
          longest ? Interval{0.1, distance + 0.5 - planted} : Interval{distance - 0.5 + planted, 5.0};
      const Manipulator one = one_leg({0.0, 0.0}, length);
      const Containment result = prove_containment(one, disc, {0.0, 0.0});
      BOOST_TEST((result.verdict == Verdict::refuted));
      const LimitEnclosure& violated = result.limits[result.tightest];
      BOOST_TEST((violated.limit == Limit{0, longest ? LimitKind::maximum_length : LimitKind::minimum_length}));
      BOOST_TEST((violated.verdict == Verdict::refuted));
      BOOST_TEST((result.limits[1 - result.tightest].verdict == Verdict::proved));
      BOOST_TEST(std::abs(violated.margin.upper + planted) < 2e-9);
      const double there = violated.margin.witness->position.norm();
      BOOST_TEST((longest ? there > length.upper : there < length.lower));
      BOOST_TEST((prove_containment(one, disc, {0.0, 0.0}, 2.0 * planted).verdict == Verdict::proved));
    }
  }
  // Within the tolerance of the limit nothing is claimed.
  const Manipulator touching = one_leg({0.0, 0.0}, {0.1, distance + 0.5});
  BOOST_TEST((prove_containment(touching, disc, {0.0, 0.0}).verdict == Verdict::undecided));
}

BOOST_AUTO_TEST_CASE(limits_of_every_kind_agree_with_samples) {
  // Wedges narrower and wider than half a turn, at the base and at the platform; where P hardly moves the orientations
  // can be sampled finely.
  const Eigen::Vector2d p(0.5, -0.2);
  const Interval narrow{0.4, 2.0};
  const Interval wide{-1.2, 2.9};
  const Manipulator manipulator("angles",
                                {Leg{{0.1, 0.2}, p, {0.3, 1.5}, narrow, {}}, Leg{{0.1, 0.2}, p, {0.3, 1.5}, wide, {}},
                                 Leg{{0.1, 0.2}, p, {0.3, 1.5}, {}, narrow}, Leg{{0.1, 0.2}, p, {0.3, 1.5}, {}, wide}});
  const Interval range{-0.5, 0.6};
  const std::vector<Limit> limits = list_limits(manipulator);
  for (const double radius : {1e-9, 0.4}) {
    for (const double direction : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
      const Eigen::Vector2d centre(1.2 * std::cos(direction), 1.2 * std::sin(direction));
      const PrescribedWorkspace prescribed("P", Ellipse{{radius, 0.6 * radius}}, {centre, 1.0, 0.3});
      const Containment result = prove_containment(manipulator, prescribed, range, 0.0, {.tolerance = 1e-7});
      BOOST_TEST(result.limits.size() == limits.size());
      for (std::size_t l = 0; l < limits.size(); ++l) {
        const Leg& leg = manipulator.leg(limits[l].leg);
        const auto margin_at = [&](const Pose& pose) {
          return -limit_value(leg, limits[l].kind, leg_vector(leg, pose), pose.orientation);
        };
        double sampled = std::numeric_limits<double>::infinity();
        if (radius < 1e-6) {
          for (int k = 0; k <= 2000; ++k) {
            sampled = std::min(sampled, margin_at({centre, range.lower + width(range) * k / 2000}));
          }
        } else {
          sampled = sampled_minimum(prescribed, range, false, margin_at);
        }
        const MinimumEnclosure& margin = result.limits[l].margin;
        BOOST_TEST_CONTEXT(to_string(limits[l]) << " in direction " << direction) {
          BOOST_TEST(margin.reached);
          BOOST_TEST(margin.lower <= sampled + 1e-8);
          BOOST_TEST(sampled - margin.upper < (radius < 1e-6 ? 5e-4 : 2e-2));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(claims)

BOOST_AUTO_TEST_CASE(a_claimed_value_is_proved_below_the_bounds_and_refuted_above) {
  const Manipulator manipulator = make_manipulator({-1.153, 0.3003, 1.275, 1.906, 0.9401}, samples::thesis_lengths());
  const MinimumEnclosure minimum = enclose_minimum(manipulator, samples::p2(), {0.0, 0.0}, printed);
  const double sampled = sampled_minimum(samples::p2(), {0.0, 0.0}, true, printed_kappa_inverse(manipulator), 200);
  BOOST_TEST((at_least(minimum, minimum.lower) == Verdict::proved));
  BOOST_TEST((at_least(minimum, sampled - 1e-5) == Verdict::proved));
  BOOST_TEST((at_least(minimum, sampled + 1e-5) == Verdict::refuted));
  BOOST_TEST((at_least(minimum, 0.5 * (minimum.lower + minimum.upper)) == Verdict::undecided));
}

BOOST_AUTO_TEST_CASE(a_smallest_value_inside_refutes_that_it_is_on_the_outline) {
  // The singular circle has the radius |q_i|; the disc reaches beyond it.
  const Manipulator manipulator = equilateral(1.0, 0.4);
  const double phi = 0.7;
  const double radius = std::sqrt(1.0 + 0.16 - 0.8 * std::cos(phi));
  const PrescribedWorkspace disc("disc", Circle{1.3 * radius}, {{0.1, 0.0}, 1.0, 0.0});
  const PartCheck check = check_minimum_on_outline(manipulator, disc, {phi, phi}, {}, {1e-4, 20'000});
  BOOST_TEST((check.verdict == Verdict::refuted));
  BOOST_TEST(check.all.upper < check.part.lower);
  BOOST_TEST(check.all.lower == 0.0);
  const double on_outline = sampled_minimum(
      disc, {phi, phi}, true, [&](const Pose& pose) { return kappa_inverse(manipulator, pose); }, 100);
  BOOST_TEST(holds({check.part.lower, check.part.upper}, on_outline, 1e-4));
  BOOST_TEST(kappa_inverse(manipulator, *check.all.witness) < 1e-2);
  BOOST_TEST(check.all.witness->position.norm() == radius, tolerance(1e-2));
  // Within the circle all is well.
  const PrescribedWorkspace small("small", Circle{0.8 * radius}, {{0.1, 0.0}, 1.0, 0.0});
  BOOST_TEST((check_minimum_on_outline(manipulator, small, {phi, phi}).verdict == Verdict::proved));
}

BOOST_AUTO_TEST_CASE(a_smallest_value_between_the_ends_refutes_that_it_is_at_one) {
  // At phi = 0 the manipulator is singular everywhere.
  const Manipulator manipulator = equilateral(1.0, 0.4);
  const PrescribedWorkspace disc("disc", Circle{0.3}, {{0.1, 0.05}, 1.0, 0.0});
  const PartCheck check = check_minimum_at_range_ends(manipulator, disc, {-0.4, 0.6}, {}, {1e-3, 20'000});
  BOOST_TEST((check.verdict == Verdict::refuted));
  BOOST_TEST(std::abs(check.all.witness->orientation) < 0.1);
  BOOST_TEST(check.all.upper < check.part.lower);
  BOOST_TEST((check_minimum_at_range_ends(manipulator, disc, {0.2, 0.6}).verdict == Verdict::proved));
}

BOOST_AUTO_TEST_CASE(verdicts_agree_with_samples) {
  // Designs of the thesis's family and regions at random, some around the best conditioned poses, some not.
  Random random;
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < 40; ++i) {
    const Manipulator manipulator = make_manipulator(
        {random.between(-1.5, -0.5), 0.0, random.between(0.5, 1.5), random.between(1.6, 2.5), random.between(0.3, 1.2)},
        samples::thesis_lengths());
    const PrescribedWorkspace disc("disc", Circle{random.between(0.05, 0.6)},
                                   {{random.between(-1.0, 2.0), random.between(0.3, 2.0)}, 1.0, 0.0});
    const Interval range{random.between(-0.5, 0.0), random.between(0.0, 0.5)};
    const double on_outline = sampled_minimum(disc, range, true, printed_kappa_inverse(manipulator));
    const double anywhere = sampled_minimum(disc, range, false, printed_kappa_inverse(manipulator));
    for (const double precision : {3e-2, 1e-5}) {
      const PartCheck check = check_minimum_on_outline(manipulator, disc, range, printed, {precision, 8'000});
      BOOST_TEST(check.part.lower <= on_outline + 1e-14);
      BOOST_TEST(check.all.lower <= anywhere + 1e-14);
      if (check.verdict == Verdict::proved) BOOST_TEST(anywhere >= check.part.lower);
      if (check.verdict == Verdict::refuted) {
        BOOST_TEST(kappa_inverse(manipulator, *check.all.witness, printed) < check.part.lower);
        BOOST_TEST((check.all.witness->position - disc.centre()).norm() < std::get<Circle>(disc.shape()).radius);
      }
      ++counts[static_cast<int>(check.verdict)];
    }
  }
  BOOST_TEST_MESSAGE("proved " << counts[0] << ", refuted " << counts[1] << ", undecided " << counts[2]);
  BOOST_TEST(counts[0] >= 20);
}

BOOST_AUTO_TEST_CASE(too_few_evaluations_leave_wide_bounds_and_no_verdict) {
  const Manipulator manipulator = make_manipulator({-1.153, 0.3003, 1.275, 1.906, 0.9401}, samples::thesis_lengths());
  const Interval range{-0.1, 0.1};
  const MinimumEnclosure good = enclose_minimum(manipulator, samples::p2(), range, printed);
  for (const long few : {1L, 2L, 10L, 100L}) {
    const EnclosureOptions options{1e-6, few};
    const MinimumEnclosure bad = enclose_minimum(manipulator, samples::p2(), range, printed, options);
    BOOST_TEST(!bad.reached);
    BOOST_TEST(bad.evaluations <= few + 1);
    BOOST_TEST(bad.lower <= good.lower);
    BOOST_TEST(bad.upper >= good.upper);
    const PartCheck check = check_minimum_on_outline(manipulator, samples::p2(), range, printed, options);
    BOOST_TEST((check.verdict == Verdict::undecided));
    BOOST_TEST(
        (prove_containment(manipulator, samples::p2(), {0.0, 0.0}, 0.0, {1e-9, 1}).verdict == Verdict::undecided));
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_by_name) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Manipulator manipulator = samples::general_manipulator();
  const PrescribedWorkspace p2 = samples::p2();
  const auto refused = [](const auto& call, const std::string& part) {
    BOOST_CHECK_EXCEPTION(call(), std::invalid_argument, [&](const std::invalid_argument& error) {
      return std::string(error.what()).find(part) != std::string::npos;
    });
  };
  const auto orientations = [&](const OrientationRange& range, const std::string& part) {
    refused([&] { enclose_minimum(manipulator, p2, range); }, part);
    refused([&] { prove_containment(manipulator, p2, range); }, part);
    refused([&] { check_minimum_on_outline(manipulator, p2, range); }, part);
    refused([&] { check_minimum_at_range_ends(manipulator, p2, range); }, part);
  };
  orientations({nan, 0.0}, "lower bound of the orientations is nan");
  orientations({0.1, 0.0}, "upper bound of the orientations is 0");
  orientations({0.0, 7.0}, "width of the range of orientations is 7");
  refused([&] { check_minimum_at_range_ends(manipulator, p2, {0.1, 0.1}); }, "width of the range of orientations is 0");
  refused([&] { enclose_minimum(manipulator, p2, {0.0, 0.0}, {}, {.tolerance = 0.0}); }, "tolerance is 0");
  refused([&] { enclose_minimum(manipulator, p2, {0.0, 0.0}, {}, {.tolerance = nan}); }, "tolerance is nan");
  refused([&] { enclose_minimum(manipulator, p2, {0.0, 0.0}, {}, {.max_evaluations = 0}); }, "evaluations is 0");
  refused([&] { prove_containment(manipulator, p2, {0.0, 0.0}, -1.0); }, "allowance is -1");
  refused(
      [&] {
        enclose_minimum(manipulator, p2, {0.0, 0.0}, {Normalisation::printed, -1.0});
      },
      "characteristic length is -1");
  refused([&] { enclose_minimum({"one", {manipulator.leg(0)}}, p2, {0.0, 0.0}); }, "number of legs is 1");
  refused([&] { bound_kappa_inverse(manipulator, {{1.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}); }, "upper bound of x");
  refused([&] { bound_kappa_inverse(manipulator, {{0.0, 0.0}, {nan, 0.0}, {0.0, 0.0}}); }, "lower bound of y");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
