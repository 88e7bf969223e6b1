// The one clock of a session's log: the kernel's monotonic one, or, where the ticks are the clock, one that is moved
// on. ns. One thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace app {

class SessionClock {
 public:
  explicit SessionClock(bool steps) : steps_(steps) {}

  /// It is moved on by what happens.
  bool steps() const { return steps_; }
  std::int64_t now_ns() const {
    return steps_ ? stepped_ns_ : std::chrono::steady_clock::now().time_since_epoch().count();
  }
  /// Never back.
  void moveTo(std::int64_t t_ns) { stepped_ns_ = std::max(stepped_ns_, t_ns); }

 private:
  bool steps_;
  std::int64_t stepped_ns_ = 0;
};

}  // namespace app
