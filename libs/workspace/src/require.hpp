#pragma once

// Checks of arguments shared by the sources of this library.

#include <sstream>
#include <stdexcept>

namespace reprise {

/// Throws std::invalid_argument, naming the argument, its value and what is allowed, unless the condition holds.
template <class Value>
void require(bool holds, const char* name, const Value& value, const char* allowed) {
  if (holds) return;
  std::ostringstream message;
  message << name << " is " << value << ", but it must be " << allowed;
  throw std::invalid_argument(message.str());
}

}  // namespace reprise
