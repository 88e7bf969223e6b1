// A device that is only looked at: it says where a hand holds an instrument - mirror, retractor - and is never told a
// force, its motors stay off. It touches nothing and cuts nothing. The device's thread brings the newest state, one
// other thread reads it. Frame D, mm. Without real-time priority: that and its core belong to the hand that feels.
// start(), stop() and step() as DeviceLoop's.
#pragma once

#include <atomic>
#include <optional>

#include "haptics/latest.h"
#include "haptics/loop/device_loop.h"

namespace haptics {

class InstrumentTracker final : public DeviceLoop {
 public:
  /// Borrows the device. Throws DeviceError when the rate is outside 500..10000 Hz.
  InstrumentTracker(ServedDevice served, double rate_Hz);
  ~InstrumentTracker() override { stop(); }

  /// The last state that could be believed: healthy, calibrated, its pose a pose. None before there is one, and none
  /// once the device has for half a second brought nothing to believe. Always the same thread.
  std::optional<HandleState> newest();

  /// How often the device began to bring what can not be believed. Any thread.
  std::uint64_t dropouts() const noexcept { return dropouts_.load(std::memory_order_relaxed); }

 private:
  struct Seen {
    HandleState state;
    bool any = false;
    double invalid_s = 0.0;  ///< since it could last be believed
  };

  Answer answer(const HandleState& state, const TickTiming& timing) noexcept override;

  Latest<Seen> newest_;
  std::atomic<std::uint64_t> dropouts_{0};
  Seen seen_;  ///< of the device's thread

  // Of the reader.
  std::uint64_t ticks_read_ = 0;
  std::int64_t last_tick_ns_ = 0;
};

}  // namespace haptics
