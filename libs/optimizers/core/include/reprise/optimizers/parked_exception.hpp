#pragma once

// For authors of solvers whose library no exception may cross.

#include <exception>
#include <utility>

namespace reprise {

/// What a callback throws, kept until the library that called it has returned.
class ParkedException {
 public:
  /// Runs the body and returns true. When it throws (StopRequest included) the exception is kept, and false is
  /// returned, now and at every later call, which runs nothing: the solver must stop.
  template <class Body>
  bool attempt(Body&& body) noexcept {
    if (exception_) return false;
    try {
      std::forward<Body>(body)();
    } catch (...) {
      exception_ = std::current_exception();
    }
    return !exception_;
  }

  /// Throws what is kept, if anything: to be called as soon as the library has returned.
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::exception_ptr exception_;
};

}  // namespace reprise
