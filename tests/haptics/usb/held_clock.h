// A USB clock that only the test advances: timeouts happen when the test says so, and a busy machine changes nothing.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "haptics/device/usb/usb_clock.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace simulated_usb {

class HeldClock {
 public:
  haptics::UsbClock clock() const { return {&now_ns_}; }
  void pass(std::chrono::milliseconds time) { now_ns_.fetch_add(std::chrono::nanoseconds(time).count()); }

  /// Advances by `time` and waits until the bus has been served a few times.
  void passAndSettle(std::chrono::milliseconds time, const Bus& bus) {
    pass(time);
    settle(bus);
  }
  static void settle(const Bus& bus) {
    const int seen = bus.looks();
    while (bus.looks() < seen + 8) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }

 private:
  std::atomic<std::int64_t> now_ns_{1'000'000'000};
};

}  // namespace simulated_usb
