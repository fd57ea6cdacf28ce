#pragma once

// Checks of arguments: one sentence for whatever is wrong with one.

#include <Eigen/Core>
#include <concepts>
#include <string>
#include <string_view>

/// All of Reprise. Each library has a folder of headers, `reprise/<library>`.
namespace reprise {

/// A number as messages show it: the fewest digits that read back to the same value, "1e-09", "0.1", "nan".
std::string shown(double value);

/// A vector as messages show it: "(1, 0.5)".
std::string shown(const Eigen::Ref<const Eigen::VectorXd>& vector);

/// Throws std::invalid_argument: "<name> is <value>, but it must be <allowed>".
[[noreturn]] void reject(std::string_view name, std::string_view value, std::string_view allowed);

/// Throws as reject does unless the condition holds. Where it holds, no text is put together. The value is a number, a
/// vector or a text.
template <class Value>
void require(bool holds, std::string_view name, const Value& value, std::string_view allowed) {
  if (holds) [[likely]] {
    return;
  }
  if constexpr (std::integral<Value>) {
    reject(name, std::to_string(value), allowed);
  } else if constexpr (std::convertible_to<Value, std::string_view>) {
    reject(name, value, allowed);
  } else {
    reject(name, shown(value), allowed);
  }
}

}  // namespace reprise
