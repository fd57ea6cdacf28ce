#pragma once

// Files that appear whole or not at all.

#include <chrono>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reprise {

/// What speaks against writing a file of this name, as in "there is no folder x", or "" when nothing does. A symbolic
/// link stands for what it points to.
std::string obstacle_to_file(const std::filesystem::path& path);

/// What speaks against writing files into a folder that is there, or can be made: in one that is there or, when
/// `parents` says so, together with the folders above it.
std::string obstacle_to_folder(const std::filesystem::path& path, bool parents = false);

/// Makes a folder, and those above it only when `parents` says so. Returns whether it is new. Throws std::runtime_error
/// when the file system refuses.
bool make_folder(const std::filesystem::path& path, bool parents = false);

/// While one of these lives, no other program of this project writes into the folder; this one does. It is a lock of
/// the operating system on the folder itself: it leaves no file, and ends with the program however that ends. Where a
/// file system has no locks nothing is kept out.
class FolderLock {
 public:
  /// Waits for another program as long as `patience` says, then throws std::runtime_error, as where the folder is not
  /// there.
  FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds patience);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  bool holds() const { return holds_; }  ///< false where the file system has no locks

 private:
  int descriptor_ = -1;
  bool holds_ = false;
  bool outer_ = false;  ///< false where an older lock of this program holds the folder
};

/// Writes files, by name and content, into a folder that is there: all of them or none. They are written beside the old
/// ones under other names and take their places together, under a FolderLock, so that two programs do not mix their
/// files. When that fails nothing is left behind, and old files are as before; what a program that was killed has left
/// is removed by the next one. A symbolic link stays, and what it points to is written; permissions stay too. Throws
/// std::runtime_error, naming the file, when the file system refuses.
void write_files(const std::filesystem::path& folder, const std::vector<std::pair<std::string, std::string>>& files);

/// The same for one file.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The content of a file. Throws std::runtime_error, naming the file, when it cannot be read, or is longer than `most`
/// bytes (of which no more are read, so that files without an end are refused too).
std::string read_file(const std::filesystem::path& path, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace reprise
