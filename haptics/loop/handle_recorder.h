// Records every handle state of a device with its time; the motors stay off. For calibration measurements. The device's
// thread writes, one other thread reads. Frame D, mm. Without real-time priority. start() and stop() as DeviceLoop's.
// For the newest state alone: instrument_tracker.
#pragma once

#include <vector>

#include "haptics/loop/device_loop.h"
#include "haptics/spsc_ring.h"

namespace haptics {

struct TimedHandle {
  double t_s = 0.0;  ///< since construction, on the clock of the ticks
  HandleState state;
};

class HandleRecorder final : public DeviceLoop {
 public:
  /// Borrows the device. Throws DeviceError if the rate is outside 500..10000 Hz.
  HandleRecorder(ServedDevice served, double rate_Hz);
  ~HandleRecorder() override { stop(); }

  /// Appends all states since the last call, valid or not. Always the same thread.
  void takeInto(std::vector<TimedHandle>& out) { log_.drainInto(out); }
  /// States lost because takeInto() came too late; the buffer holds 4 s at 1 kHz.
  std::uint64_t dropped() const { return log_.dropped(); }

 private:
  Answer answer(const HandleState& state, const TickTiming& timing) noexcept override;

  const std::int64_t began_ns_ = now_ns();
  SpscRing<TimedHandle> log_{4'000};
};

}  // namespace haptics
