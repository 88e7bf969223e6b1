// Wall time between two readings of the steady clock. Any thread.
#pragma once

#include <chrono>

namespace app {

inline double secondsBetween(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace app
