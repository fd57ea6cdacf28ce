#include "support/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "build_information.hpp"

namespace reprise::experiments {

std::filesystem::path data_folder() { return build_information::data_folder; }

void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  namespace fs = std::filesystem;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(fmt::format("cannot make the folder {}: {}.", folder.string(), error.message()));

  // The name keeps the extension, for writers that look at it, and holds the process, so that two programs that write
  // the same file do not meet.
  const fs::path beside = folder / fmt::format(".{}.{}{}", path.stem().string(), ::getpid(), path.extension().string());
  try {
    write(beside);
    const auto size = fs::file_size(beside, error);
    if (error || size == 0) throw std::runtime_error(fmt::format("nothing was written to {}.", path.string()));
    fs::rename(beside, path, error);
    if (error) throw std::runtime_error(fmt::format("cannot write {}: {}.", path.string(), error.message()));
  } catch (...) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw;
  }
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  replace_file(path, [&](const std::filesystem::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) throw std::runtime_error(fmt::format("cannot write {}: the file system refuses.", path.string()));
  });
}

std::string read_file(const std::filesystem::path& path, std::size_t most) {
  std::ifstream stream(path, std::ios::binary);
  std::string content;
  std::array<char, 65536> block;
  while (stream.good() && content.size() <= most) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    content.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (std::filesystem::is_directory(path) || (!stream.good() && !stream.eof())) {
    throw std::runtime_error(fmt::format("cannot read {}.", path.string()));
  }
  if (content.size() > most) {
    throw std::runtime_error(
        fmt::format("{} is longer than {} bytes, which is more than is read.", path.string(), most));
  }
  return content;
}

}  // namespace reprise::experiments
