#include "haptics/device/simulated/replay_device.h"

#include <cmath>
#include <utility>

namespace haptics {

ReplayDevice::ReplayDevice(std::vector<HandleState> states, double dt_s) : states_(std::move(states)), dt_s_(dt_s) {
  const double rate_Hz = 1.0 / dt_s;
  if (states_.empty()) throw DeviceError("replayed hand: the recording holds no movement, choose another");
  if (!(rate_Hz > 499.0 && rate_Hz < 10'001.0))
    throw DeviceError("replayed hand: the recording's rate is not one of 500 to 10000 Hz, choose another");
  capabilities_.model = "replayed hand";
  capabilities_.provenance = Provenance::replay;
  // Whole hertz: the period of a recording is a rounded number.
  capabilities_.min_rate_Hz = std::floor(rate_Hz - 1e-6);
  capabilities_.max_rate_Hz = std::ceil(rate_Hz + 1e-6);
}

HandleState ReplayDevice::exchange(const Wrench<calibration::Device>&, double) noexcept {
  if (next_ < states_.size()) return states_[next_++];
  HandleState last = states_.back();
  last.velocity_D_mm_per_s = {};
  last.pedal = false;
  return last;
}

}  // namespace haptics
