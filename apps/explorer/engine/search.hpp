#pragma once

// The search for the best design, as the page runs it: Dynamic-Q from the file's own design. Nothing is proved here;
// `reprise synthesize` does that.

#include <functional>
#include <string>

#include "reprise/study/documents.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise::explorer {

/// f and g of the area formulation (area_formulation.hpp) at the file's own design: `kappa_inv`, null where the chord
/// method fails, and `constraint`, an area in the file's unit. The chord is the chapter's in the unit in which the
/// longest leg is 2.
Json design_json(const ProblemInput& problem);

/// The least kappa^-1 at the slices or both ends of the range, and the largest violation of a limit, a length, of the
/// file's own design, by 2000 points of the outline: `kappa_inv`, `violation`.
Json assessment_json(const ProblemInput& problem);

/// Searches for the best design in a formulation:
///     area       Dynamic-Q with LFOPC and the chapter's settings for SO, MO or D (sections 5.6.2, 5.7.2, 5.8.2)
///     pointwise  the safeguarded Dynamic-Q with an exchange of constraints, on the side of the singular poses where
///     the
///                start prevails and, where that leads to no design that reaches the workspace, on the other side
/// `report` is given each iterate: the keys of `history` in json.md, `kappa_inv` and `violation` as there, with
/// `manipulator` (problem_json.hpp) added. The answer has the keys design, status, message, evaluations,
/// gradient_evaluations and violation as json.md has them, violation and `kappa_inv` by 2000 points of the outline at
/// the slices or both ends of the range, and manipulator. Throws std::invalid_argument for another formulation.
Json search(const ProblemInput& problem, const std::string& formulation,
            const std::function<void(const Json&)>& report);

}  // namespace reprise::explorer
