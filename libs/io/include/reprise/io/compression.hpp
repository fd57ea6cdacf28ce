#pragma once

// Texts in the format of gzip.

#include <limits>
#include <string>
#include <string_view>

namespace reprise {

/// The content of a .gz file, without a name or a time in it: the same text gives the same bytes.
std::string compress(std::string_view text);

/// The text of such a file. Throws std::runtime_error where it is not one, or is longer than `most` bytes.
std::string decompress(std::string_view compressed, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace reprise
