#include "app/device/ticking.h"

namespace app {

haptics::ServedDevice servedAs(haptics::HapticDevice& device, Ticking ticking) {
  if (ticking == Ticking::by_itself) return device;
  auto* const in_numbers = dynamic_cast<haptics::DeviceInNumbers*>(&device);
  if (in_numbers == nullptr)
    throw haptics::DeviceError(device.capabilities().model +
                               ": only a hand in numbers can go faster than the clock, leave --pace fast out");
  return haptics::ServedDevice::byHand(*in_numbers);
}

}  // namespace app
