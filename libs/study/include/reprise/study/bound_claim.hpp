#pragma once

// The claim that a certificate proves, as a file beside it:
//     problem = "../P1.toml"          # the problem file, from the folder of the claim
//     tree = "SO_P1.cert.gz"          # the certificate, alike: see bound_certificate.hpp; compressed by gzip
//     side = 1                        # the sign of r
//     bound = 0.9168990328            # no design of that side has a larger kappa^-1
//     root = [[-1, 3], ...]           # the root box, variable by variable

#include <filesystem>
#include <string>

#include "reprise/checker/check_certificate.hpp"
#include "reprise/study/problem_file.hpp"

namespace reprise {

/// A claim with what it is about.
struct StoredClaim {
  std::filesystem::path problem;  ///< as the file gives it
  std::filesystem::path tree;     ///< as the file gives it
  BoundClaim claim;               ///< what is claimed
};

/// The claim as a file.
std::string to_toml(const StoredClaim& claim);

/// Reads a claim. Throws InputError as the functions of problem_file.hpp do.
StoredClaim read_claim(const std::filesystem::path& file);

/// A claim, the problem that it is about, and what came of the check.
struct CheckedClaim {
  BoundClaim claim;      ///< what is claimed
  ProblemInput problem;  ///< of which
  CheckResult result;    ///< what the checker says
};

/// Reads a claim, its problem and its certificate, and checks it. Throws InputError for files that cannot be read; a
/// certificate that is none, or does not prove the claim, is a result.
CheckedClaim check_claim(const std::filesystem::path& file);

}  // namespace reprise
