// Whether a hand ticks by itself, as the clock goes, or is stepped: then its time is the ticks that it is told to make,
// and no clock is in what comes of it. Start-up only.
#pragma once

#include "haptics/loop/served_device.h"

namespace app {

enum class Ticking { realtime, stepped };

/// Throws haptics::DeviceError for what can not be stepped: a real device.
haptics::ServedDevice servedAs(haptics::HapticDevice& device, Ticking ticking);

}  // namespace app
