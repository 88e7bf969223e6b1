#include "haptics/loop/handle_recorder.h"

namespace haptics {

HandleRecorder::HandleRecorder(ServedDevice served, double rate_Hz) : DeviceLoop(served, rate_Hz, std::nullopt) {
  disableForce();
}

DeviceLoop::Answer HandleRecorder::answer(const HandleState& state, const TickTiming& timing) noexcept {
  log_.push({1e-9 * static_cast<double>(timing.at_ns - began_ns_), state});
  return {{}, false};
}

}  // namespace haptics
