#include "reprise/study/bound_claim.hpp"

#include <fmt/format.h>

#include "reprise/io/compression.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/toml_reader.hpp"

namespace reprise {

std::string to_toml(const StoredClaim& claim) {
  std::string root;
  for (const Interval& range : claim.claim.root) {
    root += fmt::format("{}[{}, {}]", root.empty() ? "" : ", ", range.lower, range.upper);
  }
  return fmt::format(
      "# No design with r {} 0 has a larger kappa^-1 than this bound and reaches the workspace of the problem.\n"
      "problem = \"{}\"\ntree = \"{}\"\nside = {}\nbound = {}\nroot = [{}]\n",
      claim.claim.side > 0 ? ">" : "<", claim.problem.generic_string(), claim.tree.generic_string(), claim.claim.side,
      claim.claim.bound, root);
}

StoredClaim read_claim(const std::filesystem::path& file) {
  const toml::table content = parse_toml(file);
  const TomlSection section(file, content);
  section.allow_only({"problem", "tree", "side", "bound", "root"});
  StoredClaim claim{section.text("problem"), section.text("tree"), {}};
  const double side = section.number("side");
  if (side != 1.0 && side != -1.0) section.reject("side", "1 or -1");
  claim.claim.side = side > 0.0 ? 1 : -1;
  claim.claim.bound = section.number("bound", NumberRange::positive(1.0));
  for (const auto& [lower, upper] : section.pairs("root")) {
    if (lower > upper) section.reject("root", "pairs [lower, upper] with lower <= upper");
    claim.claim.root.push_back({lower, upper});
  }
  return claim;
}

CheckedClaim check_claim(const std::filesystem::path& file) {
  constexpr std::size_t most_bytes = 1'000'000'000;
  const StoredClaim stored = read_claim(file);
  CheckedClaim checked{stored.claim, read_problem(file.parent_path() / stored.problem), {}};
  const std::filesystem::path tree = file.parent_path() / stored.tree;
  std::string content;
  try {
    content = read_file(tree, most_bytes);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
  std::string text;
  try {
    text = decompress(content, most_bytes);
  } catch (const std::runtime_error& error) {
    checked.result.failure = fmt::format("The certificate {} cannot be read: {}.", tree.string(), error.what());
    return checked;
  }
  try {
    checked.result = check_certificate(checked.problem.task, checked.claim, text);
    return checked;
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace reprise
