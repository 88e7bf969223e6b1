// Fit of a device's real force from a balance: shown = scale * requested + offset by least squares, with the standard
// error of the scale. N; any thread.
#pragma once

#include <span>

#include "haptics/device/usb/falcon_force_scale.h"

namespace app {

using haptics::ForceReading;

struct ForceScaleFit {
  double scale = 1.0, scale_error = 0.0;  ///< standard error, 0 for two readings
  double offset_N = 0.0, worst_N = 0.0;   ///< worst: the farthest reading from the line
};

/// Needs two readings of different force (assert).
ForceScaleFit forceScale(std::span<const ForceReading> readings);

/// What a balance shows in grams for 1 N: 1000/9.80665.
inline constexpr double kGrams_per_N = 1000.0 / 9.80665;

}  // namespace app
