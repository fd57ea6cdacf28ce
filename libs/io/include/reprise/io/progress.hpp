#pragma once

// One line that says how far a program is, on a terminal only.

#include <chrono>
#include <cstddef>
#include <string>

namespace reprise {

/// Shows "[ 3/18] P1 dynamic_q, about 20 s left" on standard error while it lives, and nothing where standard error is
/// not a terminal. What is left is taken to be as long, step by step, as what is done.
class Progress {
 public:
  /// The number of steps that the whole job has.
  explicit Progress(std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Says what begins now; every call counts one of `total` as begun.
  void begin(const std::string& what);

  /// Says how far that is.
  void note(const std::string& what);

 private:
  std::string left() const;
  void show(const std::string& what) const;

  std::size_t total_;
  std::size_t begun_ = 0;
  std::string begun_what_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool shown_;
};

}  // namespace reprise
