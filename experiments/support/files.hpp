#pragma once

// Files that appear whole or not at all, and where the project's own files are.

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

namespace reprise::experiments {

/// The folder data/ of the source tree the programs were built from.
std::filesystem::path data_folder();

/// Calls `write` with the path of a file beside `path`, then renames that file to `path`; makes the folder when it is
/// not there. When `write` throws or leaves no file or an empty one, nothing is left behind and `path` is as before.
/// Throws std::runtime_error, naming the file, when the file system refuses.
void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

/// replace_file with the given content.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The content of a file. Throws std::runtime_error, naming the file, when it cannot be read, or is longer than `most`
/// bytes (of which no more are read, so that files without an end are refused too).
std::string read_file(const std::filesystem::path& path, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace reprise::experiments
