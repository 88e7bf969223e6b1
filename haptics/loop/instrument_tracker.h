// A device used as a tracker: reports the pose of an instrument - mirror, retractor - in the other hand; its motors
// stay off, and it touches and cuts nothing. The device's thread brings the newest state, one other thread reads it.
// Frame D, mm. Without real-time priority: that and a core belong to the haptic loop. start(), stop() and step() as
// DeviceLoop's.
#pragma once

#include <atomic>
#include <optional>

#include "haptics/latest.h"
#include "haptics/loop/device_loop.h"
#include "haptics/loop/tick_watchdog.h"

namespace haptics {

class InstrumentTracker final : public DeviceLoop {
 public:
  /// Borrows the device. Throws DeviceError if the rate is outside 500..10000 Hz.
  InstrumentTracker(ServedDevice served, double rate_Hz);
  ~InstrumentTracker() override { stop(); }

  /// The last valid state: healthy, calibrated, a rigid pose. None before the first, and none after half a second
  /// without one. Always the same thread.
  std::optional<HandleState> newest();

  /// How often the states became invalid. Any thread.
  std::uint64_t dropouts() const noexcept { return dropouts_.load(std::memory_order_relaxed); }

 private:
  struct Seen {
    HandleState state;
    bool any = false;
    double invalid_s = 0.0;  ///< since the last valid state
  };

  Answer answer(const HandleState& state, const TickTiming& timing) noexcept override;

  Latest<Seen> newest_;
  std::atomic<std::uint64_t> dropouts_{0};
  Seen seen_;              ///< device thread
  TickWatchdog watchdog_;  ///< reading thread
};

}  // namespace haptics
