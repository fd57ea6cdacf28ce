#include "reprise/io/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace reprise {

namespace {

constexpr const char* clear_line = "\r\x1b[K";

/// A time for people: "12 s", "3 min", "2 h".
std::string in_words(double seconds) {
  constexpr double minute = 60.0;
  constexpr double hour = 3600.0;
  if (seconds < 2.0 * minute) return fmt::format("{:.0f} s", seconds);
  return seconds < 2.0 * hour ? fmt::format("{:.0f} min", seconds / minute) : fmt::format("{:.0f} h", seconds / hour);
}

}  // namespace

Progress::Progress(std::size_t total) : total_(total), shown_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_ && begun_ > 0) fmt::print(stderr, "{}", clear_line);
}

void Progress::begin(const std::string& what) {
  begun_what_ = what + left();
  ++begun_;
  show(begun_what_);
}

void Progress::note(const std::string& what) { show(begun_what_ + ", " + what); }

std::string Progress::left() const {
  constexpr std::chrono::seconds enough(3);
  constexpr std::size_t enough_steps = 3;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
  if (passed < enough || begun_ < enough_steps || begun_ >= total_) return "";
  return fmt::format(", about {} left",
                     in_words(passed.count() / static_cast<double>(begun_) * static_cast<double>(total_ - begun_)));
}

void Progress::show(const std::string& what) const {
  if (!shown_) return;
  const std::string total = std::to_string(total_);
  fmt::print(stderr, "{}[{:>{}}/{}] {}", clear_line, begun_, total.size(), total, what);
  std::fflush(stderr);
}

}  // namespace reprise
