#pragma once

// The proof that no design is better than the best one found, which `reprise synthesize` adds, and `check`.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise::app {

/// Names of the files of both signs of r.
inline const std::vector<std::string> certificate_files{"certificate.toml", "certificate.cert.gz",
                                                        "certificate_turned.toml", "certificate_turned.cert.gz"};

/// Boxes of designs for each sign of r that a proof takes unasked: below a second for both.
constexpr long unasked_boxes = 16'000;

/// What is proved of both signs of r together.
struct GlobalProof {
  bool settled = false;                   ///< the bounds of both signs are within the gap
  double lower = 0.0;                     ///< the smallest kappa^-1 of the best design found by the proof
  double upper = 1.0;                     ///< no design has a larger one
  std::optional<Eigen::VectorXd> design;  ///< with `lower`
  std::string text;                       ///< in sentences
  Json document;                          ///< the same for programs
  std::vector<std::pair<std::string, std::string>> files;
};

/// Why no proof can go through the designs of a problem, in a sentence; nothing where one can.
std::optional<std::string> not_provable(const ProblemInput& problem);

/// Searches both signs of r until the bounds are within the gap, the boxes are used up for one of them, or `stop` says
/// true. `found` is a value that a design found otherwise is proved to reach. Throws as prove_global_optimum.
GlobalProof prove_globally(const ProblemInput& problem, const std::filesystem::path& file, double gap, double found,
                           long max_boxes, const std::function<bool()>& stop);

std::unique_ptr<Command> check_command();

}  // namespace reprise::app
