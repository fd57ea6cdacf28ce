#include "branch_and_bound.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <vector>

namespace reprise::rigorous {
namespace {

/// The coordinates of a cell: position u = O' + s w(t) on one piece of the outline's chart, and the orientation.
enum Coordinate : std::size_t { t, s, phi };

/// A box of poses in these coordinates. One without width is fixed: the cell is a face, an edge or a point.
struct Cell {
  std::size_t piece;
  std::array<Interval, 3> range;
  double lower;  ///< bound of the function's values
  long number;   ///< cells of equal bounds are taken in the order in which they were made
};

struct TakenLater {
  bool operator()(const Cell& a, const Cell& b) const {
    return a.lower != b.lower ? a.lower > b.lower : a.number > b.number;
  }
};

bool fixed(const Interval& range) { return range.lower == range.upper; }

/// Where the mean value form with this derivative has its greatest lower bound (E. Baumann, Optimal centered forms, BIT
/// 28, 1988).
double centre_of(const Interval& range, const Enclosure& derivative) {
  if (derivative.lower() >= 0.0) return range.lower;
  if (derivative.upper() <= 0.0) return range.upper;
  const double share = derivative.upper() / (derivative.upper() - derivative.lower());
  const double centre = range.upper + share * (range.lower - range.upper);
  return centre >= range.lower && centre <= range.upper ? centre : std::midpoint(range.lower, range.upper);
}

class BranchAndBound {
 public:
  BranchAndBound(const PoseFunction& function, const Outline& outline, const Interval& orientations, const Search& what,
                 const EnclosureOptions& options)
      : function_(function), outline_(outline), orientations_(orientations), what_(what), options_(options) {
    result_.upper = what.below;
    const Interval positions = what.positions == Part::border ? Interval{1.0, 1.0} : Interval{0.0, 1.0};
    for (std::size_t piece = 0; piece < outline.pieces(); ++piece) {
      const auto start = [&](const Interval& range) {
        add({piece, {Interval{0.0, 1.0}, positions, range}, -std::numeric_limits<double>::infinity(), 0});
      };
      if (what.orientations == Part::border) {
        start({orientations.lower, orientations.lower});
        start({orientations.upper, orientations.upper});
      } else {
        start(orientations);
      }
    }
  }

  SearchResult run() {
    while (true) {
      result_.lower = std::min({cells_.empty() ? result_.upper : cells_.top().lower, leftover_, result_.upper});
      const bool nothing_left = result_.lower >= result_.upper;
      result_.finished =
          nothing_left || (result_.witness.has_value() && result_.upper - result_.lower <= options_.tolerance);
      if (result_.finished || cells_.empty() || result_.evaluations >= options_.max_evaluations) return result_;
      const Cell cell = cells_.top();
      cells_.pop();
      examine(cell);
    }
  }

 private:
  using Ranges = std::array<Enclosure, 3>;

  void add(Cell cell) {
    cell.number = ++made_;
    cells_.push(cell);
  }

  Poses poses_of(const Ranges& ranges, const OutlineBounds& outline) const {
    return {outline_.centre().x() + ranges[s] * outline.x, outline_.centre().y() + ranges[s] * outline.y, ranges[phi]};
  }

  /// Bounds the function over a cell; then drops it, keeps a face of it, or splits it.
  void examine(Cell cell) {
    const Ranges ranges{to_enclosure(cell.range[t]), to_enclosure(cell.range[s]), to_enclosure(cell.range[phi])};
    const OutlineBounds outline = outline_.bounds(cell.piece, ranges[t]);
    ++result_.evaluations;
    const FirstOrderBounds f = function_.first_order(poses_of(ranges, outline));
    cell.lower = std::max(cell.lower, f.value.lower());
    if (cell.lower >= result_.upper) return;

    const Enclosure radial = outline.x * f.x + outline.y * f.y;
    const Enclosure tangential = outline.x_change * f.x + outline.y_change * f.y;
    switch (restrict_to_candidates(cell, f, radial, tangential)) {
      case Rest::nothing:
        return;
      case Rest::face:
        add(cell);
        return;
      case Rest::all:
        break;
    }

    const Ranges slope{ranges[s] * tangential, radial, f.orientation};
    const std::array<double, 3> centre{centre_of(cell.range[t], slope[t]), centre_of(cell.range[s], slope[s]),
                                       centre_of(cell.range[phi], slope[phi])};
    Enclosure mean_value = at(cell.piece, centre);
    for (const Coordinate k : {t, s, phi}) {
      if (!fixed(cell.range[k])) mean_value += slope[k] * (ranges[k] - centre[k]);
    }
    cell.lower = std::max(cell.lower, mean_value.lower());
    if (cell.lower < result_.upper) split(cell, slope);
  }

  enum class Rest { all, face, nothing };

  /// Leaves of a cell what may hold a smallest value. Where a derivative differs from zero in the whole cell, that is
  /// one of its faces at most, and only one that is a part of the border.
  Rest restrict_to_candidates(Cell& cell, const FirstOrderBounds& f, const Enclosure& radial,
                              const Enclosure& tangential) const {
    Rest rest = Rest::all;
    if (!fixed(cell.range[phi]) && nonzero(f.orientation)) {
      const bool grows = f.orientation.lower() > 0.0;
      const double end = grows ? cell.range[phi].lower : cell.range[phi].upper;
      const bool is_border = end == (grows ? orientations_.lower : orientations_.upper);
      if (!is_border || what_.orientations == Part::interior) return Rest::nothing;
      cell.range[phi] = {end, end};
      rest = Rest::face;
    }
    if (!fixed(cell.range[s]) && (nonzero(f.x) || nonzero(f.y) || nonzero(radial) || nonzero(tangential))) {
      if (cell.range[s].upper < 1.0 || what_.positions == Part::interior) return Rest::nothing;
      cell.range[s] = {1.0, 1.0};
      rest = Rest::face;
    }
    if (!fixed(cell.range[s])) return rest;
    if (what_.positions == Part::all && radial.lower() > 0.0) return Rest::nothing;  // smaller values lie further in
    if (!fixed(cell.range[t]) && nonzero(tangential)) {
      const double end = tangential.lower() > 0.0 ? cell.range[t].lower : cell.range[t].upper;
      if (end != 0.0 && end != 1.0) return Rest::nothing;
      cell.range[t] = {end, end};  // where pieces meet there may be a corner
      rest = Rest::face;
    }
    return rest;
  }

  /// The function at a pose, which may be the smallest value found so far.
  Enclosure at(std::size_t piece, const std::array<double, 3>& coordinates) {
    const Ranges ranges{Enclosure(coordinates[t]), Enclosure(coordinates[s]), Enclosure(coordinates[phi])};
    const Poses poses = poses_of(ranges, outline_.bounds(piece, ranges[t]));
    ++result_.evaluations;
    const Enclosure value = function_.value(poses);
    if (value.upper() < std::min(result_.upper, what_.found_below)) {
      result_.upper = value.upper();
      result_.witness = Pose{{median(poses.x), median(poses.y)}, coordinates[phi]};
    }
    return value;
  }

  /// Halves the cell in the coordinate in which the function varies most.
  void split(const Cell& cell, const Ranges& slope) {
    std::optional<Coordinate> widest;
    double most = -1.0;
    for (const Coordinate k : {t, s, phi}) {
      const Interval& range = cell.range[k];
      const double middle = std::midpoint(range.lower, range.upper);
      if (middle == range.lower || middle == range.upper) continue;
      // Where nothing is known of the slope the coordinates count alike.
      const double variation =
          std::min(norm(slope[k]), std::numeric_limits<double>::max()) * (range.upper - range.lower);
      if (variation > most) {
        widest = k;
        most = variation;
      }
    }
    if (!widest) {
      leftover_ = std::min(leftover_, cell.lower);
      return;
    }
    const Interval& range = cell.range[*widest];
    const double middle = std::midpoint(range.lower, range.upper);
    Cell half = cell;
    half.range[*widest].upper = middle;
    add(half);
    half = cell;
    half.range[*widest].lower = middle;
    add(half);
  }

  const PoseFunction& function_;
  const Outline& outline_;
  Interval orientations_;
  Search what_;
  EnclosureOptions options_;
  SearchResult result_;
  std::priority_queue<Cell, std::vector<Cell>, TakenLater> cells_;
  long made_ = 0;
  /// The smallest bound of the cells that cannot be split any further.
  double leftover_ = std::numeric_limits<double>::infinity();
};

}  // namespace

SearchResult search(const PoseFunction& function, const Outline& outline, const Interval& orientations,
                    const Search& what, const EnclosureOptions& options) {
  return BranchAndBound(function, outline, orientations, what, options).run();
}

}  // namespace reprise::rigorous
