#pragma once

// The program in this process.

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "command.hpp"

namespace reprise::test {

struct Ended {
  int code;
  std::string out;
  std::string err;

  nlohmann::json document() const { return nlohmann::json::parse(out); }

  /// With --json: one document and exit code 0, or 1 where it says that something is missing.
  bool is_answer() const {
    if (!err.empty() || !nlohmann::json::accept(out)) return false;
    return code == 0 || (code == 1 && !document().value("complete", false));
  }
  /// One clear sentence, and nothing on standard output.
  bool is_refusal() const {
    return code == 2 && out.empty() && err.starts_with("reprise ") && err.ends_with(".\n") &&
           std::count(err.begin(), err.end(), '\n') == 1;
  }
};

inline Ended run(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"reprise"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out;
  std::ostringstream err;
  const int code = app::run(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

inline std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(REPRISE_SOURCE) / "examples" / (name + ".toml");
}

}  // namespace reprise::test
