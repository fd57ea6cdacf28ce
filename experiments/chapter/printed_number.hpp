#pragma once

// Numbers as the thesis prints them.

#include <string>

namespace reprise::experiments {

/// A number as printed; the true one differs by at most half a unit of the last digit.
struct PrintedNumber {
  std::string text;
  double value = 0.0;
  double half_unit = 0.0;
};

/// "0.759" is 0.759 +- 0.0005, "0.2E-5" is 2e-6 +- 5e-7. Throws std::runtime_error when the text is not a number.
PrintedNumber printed_number(const std::string& text);

}  // namespace reprise::experiments
