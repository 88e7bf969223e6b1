// A device of which every tick is wanted, and that is never told a force: its motors stay off. What a calibration
// measures with. The device's thread writes, one other thread reads. Frame D, mm. Without real-time priority. start()
// and stop() as DeviceLoop's. Of the newest state alone: passive_hand.
#pragma once

#include <vector>

#include "haptics/loop/device_loop.h"
#include "haptics/loop/handle_log.h"

namespace haptics {

class HandleRecorder final : public DeviceLoop {
 public:
  /// Borrows the device. Throws DeviceError when the rate is outside 500..10000 Hz.
  HandleRecorder(ServedDevice served, double rate_Hz);
  ~HandleRecorder() override { stop(); }

  /// All since the last call, believed or not, appended. Always the same thread.
  void takeInto(std::vector<TimedHandle>& out) { log_.drainInto(out); }
  /// That nobody took in time.
  std::uint64_t dropped() const { return log_.dropped(); }

 private:
  Answer answer(const HandleState& state, const TickTiming& timing) noexcept override;

  const std::int64_t began_ns_ = now_ns();
  HandleLog log_;
};

}  // namespace haptics
