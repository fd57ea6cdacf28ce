#pragma once

// The proof that no design is better than the best one found: what `reprise synthesize --prove` adds, and `check`.

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

/// What is proved of both signs of r together.
struct GlobalProof {
  double lower = 0.0;                     ///< the smallest kappa^-1 of the best design found by the proof
  double upper = 1.0;                     ///< no design has a larger one
  std::optional<Eigen::VectorXd> design;  ///< with `lower`
  std::string text;                       ///< in sentences
  Json document;                          ///< the same for programs
  std::vector<std::pair<std::string, std::string>> files;
};

/// Throws std::invalid_argument where the designs of the problem are none that a proof can go through.
void require_provable(const ProblemInput& problem);

/// Searches both signs of r until the bounds are within the gap, or `stop` says true. `found` is a value that a design
/// found otherwise is proved to reach. Throws as prove_global_optimum.
GlobalProof prove_globally(const ProblemInput& problem, const std::filesystem::path& file, double gap, double found,
                           const std::function<bool()>& stop);

std::unique_ptr<Command> check_command();

}  // namespace reprise::app
