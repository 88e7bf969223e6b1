#include "haptics/loop/listened_hand.h"

namespace haptics {

ListenedHand::ListenedHand(ServedDevice served, double rate_Hz) : DeviceLoop(served, rate_Hz, std::nullopt) {
  forbidForce();
}

DeviceLoop::Answer ListenedHand::answer(const HandleState& state, const Beat& beat) noexcept {
  log_.push({1e-9 * static_cast<double>(beat.at_ns - began_ns_), state});
  return {{}, false};
}

}  // namespace haptics
