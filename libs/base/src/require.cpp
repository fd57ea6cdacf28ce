#include "reprise/base/require.hpp"

#include <array>
#include <charconv>
#include <stdexcept>

namespace reprise {

std::string shown(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string shown(const Eigen::Ref<const Eigen::VectorXd>& vector) {
  std::string text = "(";
  for (Eigen::Index i = 0; i < vector.size(); ++i) text += (i == 0 ? "" : ", ") + shown(vector[i]);
  return text + ")";
}

void reject(std::string_view name, std::string_view value, std::string_view allowed) {
  std::string message(name);
  message.append(" is ").append(value).append(", but it must be ").append(allowed);
  throw std::invalid_argument(message);
}

}  // namespace reprise
