// explorer_answers: answers requests of the page natively, a line each, for tests. A request with the key `formulation`
// is a search.

#include <iostream>
#include <string>

#include "answers.hpp"

int main() {
  std::string request;
  while (std::getline(std::cin, request)) {
    const bool is_search = request.find("\"formulation\"") != std::string::npos;
    std::cout << (is_search ? reprise::explorer::respond_to_search(request, [](const std::string&) {})
                            : reprise::explorer::respond(request))
              << std::endl;
  }
}
