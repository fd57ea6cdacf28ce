#pragma once

// What is proved of one box of designs, see global_optimum.hpp.

#include <array>
#include <optional>
#include <vector>

#include "design_peaks.hpp"

namespace reprise::rigorous {

/// A box of designs.
using DesignBox = std::array<Interval, most_variables>;

/// Where a variable stands in a box.
inline std::size_t index(int variable) { return static_cast<std::size_t>(variable); }

/// A slab that was cut off a box: what lies below (or above) a value of a variable.
struct CutSlab {
  int variable;
  double at;
  bool below;            ///< whether the part below `at` is left out, else the part above
  CertificateTerm term;  ///< the limit that is violated in all of it
};

/// What leaves a box out.
struct Exclusion {
  CertificateKind kind = CertificateKind::split;  ///< split: nothing does
  double bound = 1.0;  ///< kappa^-1 is at most this in the box; 0 where no design reaches the workspace
  std::vector<CertificateTerm> terms;
};

struct Examination {
  std::vector<CutSlab> slabs;   ///< one after the other
  DesignBox box;                ///< what they leave
  Exclusion exclusion;          ///< of what they leave
  int widest = 0;               ///< the variable to split
  Variables<double> promising;  ///< a design in or near the box, from the linear program
};

class BoxExaminer {
 public:
  BoxExaminer(const SynthesisTask& task, const DesignFamily& family, const DesignBox& root);

  /// The exclusion counts as good enough, and nothing more is tried, when its bound is at most `target`.
  Examination examine(const DesignBox& box, double target) const;

  const DesignPeaks& peaks() const { return peaks_; }
  /// Whether legs 1 and 2 may change places, and whether the mirror images are as good.
  bool legs_alike() const { return legs_alike_; }
  bool mirrored_in_y() const { return mirrored_in_y_; }
  bool mirrored_in_x() const { return mirrored_in_x_; }

 private:
  using Box = Variables<Enclosure>;
  enum class Outcome { unchanged, smaller, left_out };

  Exclusion by_symmetry(const DesignBox& box) const;
  Outcome cut(Examination& result) const;
  std::optional<CertificateTerm> violated_everywhere(const DesignBox& box) const;
  bool violated(const DesignBox& box, const CertificateTerm& term) const;
  void bound_by_conditioning(const Box& wide, const std::vector<DesignPeak>& peaks, double target,
                             Exclusion& exclusion) const;
  void bound_by_combination(const DesignBox& box, const Box& wide, const std::vector<DesignPeak>& peaks,
                            Examination& result) const;
  Exclusion verify(const Box& wide, std::vector<CertificateTerm> terms) const;
  Vector2<Enclosure> position(const OutlinePose& pose) const;

  SynthesisTask task_;
  const DesignFamily& family_;
  OutlineCurve curve_;
  DesignPeaks peaks_;
  /// Of the points between which peaks are looked for.
  struct Point {
    std::size_t piece;
    double t;
    Vector2<Enclosure> position;
  };
  std::vector<Point> points_;
  DesignBox root_;
  bool legs_alike_;
  bool mirrored_in_y_;
  bool mirrored_in_x_;
};

}  // namespace reprise::rigorous
