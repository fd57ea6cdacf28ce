#include "reprise/io/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace reprise {

namespace {
constexpr const char* clear_line = "\r\x1b[K";
}

Progress::Progress(std::size_t total) : total_(total), shown_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_ && begun_ > 0) fmt::print(stderr, "{}", clear_line);
}

void Progress::begin(const std::string& what) {
  ++begun_;
  begun_what_ = what;
  show(what);
}

void Progress::note(const std::string& what) { show(begun_what_ + ", " + what); }

void Progress::show(const std::string& what) const {
  if (!shown_) return;
  const std::string total = std::to_string(total_);
  fmt::print(stderr, "{}[{:>{}}/{}] {}", clear_line, begun_, total.size(), total, what);
  std::fflush(stderr);
}

}  // namespace reprise
