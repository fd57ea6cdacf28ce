#include "reprise/io/messages.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace reprise {

namespace {

/// How many letters must be changed, put in, left out or exchanged with their neighbour to make one word the other (the
/// optimal string alignment distance).
std::size_t edits(const std::string& from, const std::string& to) {
  std::vector<std::vector<std::size_t>> least(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i) {
    for (std::size_t j = 0; j <= to.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      least[i][j] = std::min(
          {least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
      }
    }
  }
  return least[from.size()][to.size()];
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 100;  // a longer word is no slip of the keyboard
  constexpr std::size_t shortest_part = 3;
  if (word.size() > longest) return "";
  const std::string* nearest = nullptr;
  std::size_t fewest = 0;
  for (const std::string& candidate : known) {
    const std::size_t shorter = std::min(word.size(), candidate.size());
    const bool cut_short = candidate.starts_with(word) && shorter >= shortest_part;
    const bool prolonged = word.starts_with(candidate) && shorter >= shortest_part;
    const std::size_t needed = cut_short ? 1 : prolonged ? 2 : edits(word, candidate);
    if (!cut_short && !prolonged && needed > (shorter + 2) / 3) continue;
    if (nearest == nullptr || needed < fewest) {
      nearest = &candidate;
      fewest = needed;
    }
  }
  return nearest == nullptr ? "" : fmt::format("did you mean '{}'?", *nearest);
}

std::string on_one_line(const std::string& text) {
  std::string result;
  bool gap = false;
  for (const char c : text) {
    if ((c >= '\0' && c < ' ') || c == '\x7f') {
      gap = true;
      continue;
    }
    if (gap && !result.empty()) result += ' ';
    gap = false;
    result += c;
  }
  return result;
}

std::string counted(std::size_t number, const std::string& thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

}  // namespace reprise
