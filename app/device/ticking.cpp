#include "app/device/ticking.h"

namespace app {

haptics::ServedDevice servedAs(haptics::HapticDevice& device, Ticking ticking) {
  if (ticking == Ticking::realtime) return device;
  auto* const simulated = dynamic_cast<haptics::SimulatedDevice*>(&device);
  if (simulated == nullptr)
    throw haptics::DeviceError(device.capabilities().model +
                               ": only a hand in numbers can go faster than the clock, leave --pace fast out");
  return haptics::ServedDevice::steppedManually(*simulated);
}

}  // namespace app
