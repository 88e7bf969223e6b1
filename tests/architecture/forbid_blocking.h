// Counts what a real-time thread must not do, on the thread and in the scope of this object: heap allocations (malloc
// and its family, so operator new too), and calls that can block (mutex, condition variable, sleep).
// Works by standing in front of the C library's functions in the program that links this; test code only.
// A sanitizer owns malloc itself: then countsNothing() is true and the test has to skip.
#pragma once

#include <cstdint>

namespace tests {

class ForbidBlocking {
 public:
  ForbidBlocking();
  ~ForbidBlocking();
  ForbidBlocking(const ForbidBlocking&) = delete;
  ForbidBlocking& operator=(const ForbidBlocking&) = delete;

  std::uint64_t allocations() const;
  std::uint64_t blockingCalls() const;

  static bool countsNothing();
};

}  // namespace tests
