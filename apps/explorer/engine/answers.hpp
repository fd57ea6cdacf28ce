#pragma once

// What the page asks of the libraries. Questions and answers are JSON; the answers are the documents of `reprise
// --json` (apps/reprise/json.md) where there is a command for the question.

#include <functional>
#include <string>

#include "reprise/study/documents.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise::explorer {

/// The answer to one question about a file, without the head that all documents share. `question` has the key `command`
/// and what that command needs:
///     pose         position [x, y], orientation_deg
///     assemble     lengths [l_1, l_2, l_3]
///     workspace    orientation_deg
///     dextrous     range_deg [lower, upper]
///     orientation  position [x, y]
/// as in json.md, and some that `reprise` does not have:
///     problem      the file's tables with their keys, every expression as a number and every shared file copied in
///     design       f and g of the area formulation (area_formulation.hpp) at the file's own design: `kappa_inv`, null
///                  where the chord method fails, and `constraint`, an area; both null in a manipulator file
///     assessment   `kappa_inv` and `violation` of the file's own design, by 2000 points of the outline
///     outline      `points` of the prescribed workspace, in order; none in a manipulator file
///     singular     orientation_deg, box [[x, y], [x, y]]: `curves`, the singular positions (singular_curve.hpp)
/// Throws std::invalid_argument for an unknown command, and as the libraries do.
Json answer(const FileInput& input, const Json& question);

/// Answers {"file": name, "questions": [...]} by {"answers": [...]}, each a whole document, or by {"error": sentence}
/// where the file or a question is wrong.
std::string respond(const std::string& request);

/// Searches for the best design of the problem in {"file": name, "formulation": "pointwise" or "area"} as search.hpp
/// says, and answers by the document of the search or by {"error": sentence}. Each iterate is reported as text.
std::string respond_to_search(const std::string& request, const std::function<void(const std::string&)>& report);

}  // namespace reprise::explorer
