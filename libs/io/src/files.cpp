#include "reprise/io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "reprise/io/interruption.hpp"

namespace reprise {

namespace {

namespace fs = std::filesystem;

std::string reason() { return std::error_code(errno, std::generic_category()).message(); }

/// What a name stands for when all symbolic links are followed, whether there is a file or not.
fs::path followed(fs::path path) {
  std::error_code error;
  // The system gives up after forty links, too: those go round in a circle.
  for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(path, error)); ++links) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / target;
  }
  return path;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

bool is_writable_folder(const fs::path& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0; }

/// The name under which a file is written before it takes its place. It holds the process, so that programs that write
/// the same file do not meet where there are no locks.
std::string beside_name(const fs::path& file) {
  return fmt::format(".{}.{}.part", file.filename().string(), ::getpid());
}

/// Removes what programs that were killed have left of a file. Only for who holds the folder's lock: nobody else is
/// writing then.
void remove_leftovers(const fs::path& file) {
  const std::string begin = fmt::format(".{}.", file.filename().string());
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(file), error)) {
    const std::string name = entry.path().filename().string();
    const std::string_view rest = std::string_view(name).substr(std::min(begin.size(), name.size()));
    if (name.starts_with(begin) && rest.ends_with(".part") &&
        rest.find_first_not_of("0123456789") == rest.size() - std::string_view(".part").size()) {
      fs::remove(entry.path(), error);
    }
  }
}

/// Writes a new file.
void write_new(const fs::path& path, const fs::path& name, std::string_view content) {
  const auto refuse = [&] { throw std::runtime_error(fmt::format("cannot write {}: {}.", name.string(), reason())); };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), &std::fclose);
  if (!file) refuse();
  if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size()) refuse();
  // A full disk may show only now.
  if (std::fclose(file.release()) != 0) refuse();
}

/// The folders that this program has locked, by device and number.
std::vector<std::pair<dev_t, ino_t>>& locked_folders() {
  static std::vector<std::pair<dev_t, ino_t>> folders;
  return folders;
}

/// How long a program waits for another one that is writing a few files.
constexpr std::chrono::seconds usual_patience{20};

}  // namespace

std::string obstacle_to_file(const fs::path& path) {
  const fs::path file = followed(path);
  const fs::path folder = folder_of(file);
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(file, error))) return "its symbolic links go round in a circle";
  if (!fs::is_directory(folder, error)) return fmt::format("there is no folder {}", folder.string());
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) return "that is a folder";
  if (fs::exists(status) && !fs::is_regular_file(status)) return "that is not a file";
  if (fs::exists(status) && ::access(file.c_str(), W_OK) != 0) return "that file may not be written";
  if (!is_writable_folder(folder)) return fmt::format("the folder {} may not be written to", folder.string());
  return {};
}

std::string obstacle_to_folder(const fs::path& path, bool parents) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(path, error))) {
    if (!fs::is_directory(path, error)) return "that is not a folder";
    if (!is_writable_folder(path)) return "that folder may not be written to";
    return {};
  }
  // "x/" is the folder x.
  const fs::path folder = path.has_filename() ? path : path.parent_path();
  if (folder != path) return obstacle_to_folder(folder, parents);
  const fs::path above = folder_of(path);
  if (!fs::is_directory(above, error)) {
    if (parents && !fs::exists(above, error)) return obstacle_to_folder(above, true);
    return fmt::format("there is no folder {} to make it in", above.string());
  }
  if (!is_writable_folder(above)) return fmt::format("no folder may be made in {}", above.string());
  return {};
}

bool make_folder(const fs::path& path, bool parents) {
  std::error_code error;
  const bool made = parents ? fs::create_directories(path, error) : fs::create_directory(path, error);
  if (error) throw std::runtime_error(fmt::format("cannot make the folder {}: {}.", path.string(), error.message()));
  return made;
}

FolderLock::FolderLock(const fs::path& folder, std::chrono::milliseconds patience) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ == -1)
    throw std::runtime_error(fmt::format("cannot open the folder {}: {}.", folder.string(), reason()));
  struct stat status {};
  ::fstat(descriptor_, &status);
  const std::pair identity(status.st_dev, status.st_ino);
  auto& locked = locked_folders();
  if (std::find(locked.begin(), locked.end(), identity) != locked.end()) {
    holds_ = true;
    return;
  }
  const auto end = std::chrono::steady_clock::now() + patience;
  while (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;
    if (std::chrono::steady_clock::now() >= end) {
      ::close(descriptor_);
      throw std::runtime_error(
          fmt::format("another program is writing into the folder {}; wait until it has ended.", folder.string()));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  holds_ = outer_ = true;
  locked.push_back(identity);
}

FolderLock::~FolderLock() {
  if (outer_) {
    struct stat status {};
    ::fstat(descriptor_, &status);
    std::erase(locked_folders(), std::pair(status.st_dev, status.st_ino));
  }
  ::close(descriptor_);
}

void write_files(const fs::path& folder, const std::vector<std::pair<std::string, std::string>>& files) {
  const FolderLock lock(folder, usual_patience);
  std::vector<fs::path> targets;
  std::deque<TemporaryFile> written;
  for (const auto& [name, content] : files) {
    const fs::path target = followed(folder / name);
    if (const std::string obstacle = obstacle_to_file(target); !obstacle.empty()) {
      throw std::runtime_error(fmt::format("cannot write {}: {}.", (folder / name).string(), obstacle));
    }
    if (lock.holds() && fs::equivalent(folder_of(target), folder)) remove_leftovers(target);
    written.emplace_back(folder_of(target) / beside_name(target));
    write_new(written.back().path(), folder / name, content);
    std::error_code ignored;
    const fs::file_status old = fs::status(target, ignored);
    if (fs::is_regular_file(old)) fs::permissions(written.back().path(), old.permissions(), ignored);
    targets.push_back(target);
  }
  const WithoutSignals without_signals;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    if (std::rename(written[k].path().c_str(), targets[k].c_str()) != 0) {
      throw std::runtime_error(fmt::format("cannot write {}: {}.", (folder / files[k].first).string(), reason()));
    }
  }
}

void write_file(const fs::path& path, std::string_view content) {
  const fs::path file = followed(path);
  write_files(folder_of(file), {{file.filename().string(), std::string(content)}});
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

}  // namespace reprise
