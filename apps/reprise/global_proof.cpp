#include "global_proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "reprise/bounds/global_optimum.hpp"
#include "reprise/io/compression.hpp"
#include "reprise/io/progress.hpp"
#include "reprise/study/bound_claim.hpp"

namespace reprise::app {

namespace {

/// One sign of r, with its progress.
GlobalOptimum prove_side(const SynthesisTask& task, GlobalOptions options, Progress& progress) {
  progress.begin(options.side > 0 ? "proof, r > 0" : "proof, r < 0");
  options.observe = [&](const GlobalProgress& now) {
    progress.note(
        fmt::format("{:.2f} % of the designs, best {:.7f}, bound {:.7f}", 100.0 * now.share, now.lower, now.upper));
  };
  return prove_global_optimum(task, options);
}

Json side_json(const GlobalOptimum& one, int side) {
  Json design;
  if (one.design) design = std::vector<double>(one.design->begin(), one.design->end());
  return {{"side", side},       {"status", to_string(one.status)}, {"kappa_inv_min", one.lower},
          {"bound", one.upper}, {"boxes", one.counts.examined},    {"design", design}};
}

}  // namespace

std::optional<std::string> not_provable(const ProblemInput& problem) {
  try {
    prove_global_optimum(problem.task, {.max_boxes = 1, .starts = 0});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return std::nullopt;
}

GlobalProof prove_globally(const ProblemInput& problem, const std::filesystem::path& file, double gap, double found,
                           long max_boxes, const std::function<bool()>& stop) {
  GlobalProof proof;
  proof.settled = true;
  proof.upper = 0.0;
  Progress progress(2);
  GlobalOptions options{.gap = gap, .max_boxes = max_boxes, .threads = 2, .known = found, .stop = stop};
  Json sides = Json::array();
  for (const int side : {1, -1}) {
    options.side = side;
    const GlobalOptimum one = prove_side(problem.task, options, progress);
    options.known = std::max(options.known, one.lower);
    proof.upper = std::max(proof.upper, one.upper);
    if (one.design && one.lower > proof.lower) {
      proof.lower = one.lower;
      proof.design = one.design;
    }
    sides.push_back(side_json(one, side));
    const char* sign = side > 0 ? ">" : "<";
    const bool unreachable = one.status == GlobalStatus::unreachable;
    const bool done = unreachable || one.status == GlobalStatus::proved;
    proof.settled = proof.settled && done;
    const std::string effort =
        fmt::format("{} boxes{}{}", one.counts.examined, done ? "" : ", ", done ? "" : to_string(one.status));
    proof.text +=
        unreachable
            ? fmt::format("With r {} 0 no design reaches the whole workspace: proved ({}).\n", sign, effort)
            : fmt::format(
                  "With r {} 0 no design that keeps all limits has a least kappa^-1 above {:.10f}: proved ({}).\n",
                  sign, one.upper, effort);
    if (one.certificate.nodes.empty()) continue;
    const std::string name = side > 0 ? "certificate" : "certificate_turned";
    const StoredClaim claim{
        std::filesystem::absolute(file), name + ".cert.gz", {side, one.upper, one.certificate.root}};
    proof.files.emplace_back(name + ".toml", to_toml(claim));
    proof.files.emplace_back(name + ".cert.gz", compress(to_text(one.certificate)));
  }
  if (!proof.settled) proof.text += "A better design is not ruled out.\n";
  proof.document = {{"settled", proof.settled},
                    {"bound", proof.upper},
                    {"gap", proof.upper - std::max(found, proof.lower)},
                    {"sides", sides}};
  return proof;
}

namespace {

class CheckCommand final : public Command {
 public:
  CheckCommand()
      : Command("check", "Whether a certificate proves that no design is better than a bound",
                "Reads the claim that 'reprise synthesize --out' writes beside a certificate, the problem that it\n"
                "names, and the certificate, and goes through all of its boxes in interval arithmetic of its own.",
                "reprise synthesize examples/P2.toml --prove --out results\n"
                "reprise check results/certificate.toml",
                "claim, in TOML: the file beside the certificate") {}

 private:
  Output compute() override {
    const auto [claim, problem, result] = check_claim(file());
    Output output;
    output.unit = problem.start.unit;
    output.document = {{"manipulator", problem.start.manipulator.name()},
                       {"proved", result.proved},
                       {"failure", result.failure.empty() ? Json() : Json(result.failure)},
                       {"side", claim.side},
                       {"bound", claim.bound},
                       {"lines", result.lines},
                       {"leaves", result.leaves}};
    output.text = result.proved
                      ? fmt::format("PROVED: with r {} 0 no design has a least kappa^-1 above {}; {} boxes checked.\n",
                                    claim.side > 0 ? ">" : "<", claim.bound, result.leaves)
                      : "NOT PROVED. " + result.failure + "\n";
    output.exit_code = result.proved ? 0 : 1;
    return output;
  }
};

}  // namespace

std::unique_ptr<Command> check_command() { return std::make_unique<CheckCommand>(); }

}  // namespace reprise::app
