// check_certificate CLAIM: whether a certificate proves that no design is better than a bound. It says PROVED and ends
// with the exit code 0, or says what fails and ends with 1; with 2 where the files cannot be read.

#include <fmt/format.h>

#include <exception>
#include <iostream>
#include <string>

#include "reprise/study/bound_claim.hpp"

int main(int argc, char** argv) {
  if (argc != 2 || std::string(argv[1]) == "--help") {
    (argc == 2 ? std::cout : std::cerr)
        << "Usage: check_certificate CLAIM.toml, a file that reprise synthesize --prove "
           "writes beside its certificate.\n";
    return argc == 2 ? 0 : 2;
  }
  try {
    const reprise::CheckResult result = reprise::check_claim(argv[1]).result;
    std::cout << (result.proved ? fmt::format("PROVED, {} boxes checked.", result.leaves) : result.failure)
              << std::endl;
    return result.proved && std::cout ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "check_certificate: " << error.what() << '\n';
    return 2;
  }
}
