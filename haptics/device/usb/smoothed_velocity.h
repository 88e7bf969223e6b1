// The velocity of a handle whose places are measured in counts: differences behind one pole at 50 Hz. At 1 kHz a count
// is up to 40 mm/s of a Falcon from one tick to the next and 80 mm/s of a WoodenHaptics; 10 and 20 behind it. Frame D,
// mm, s. The device's thread.
#pragma once

#include <cmath>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/geometry/units.h"

namespace haptics {

/// After the handle `moved` for so long; where that is no time it stands.
inline void follow(calibration::Vector<calibration::Device>& velocity_D_mm_per_s, const glm::dvec3& moved_D_mm,
                   double since_s) {
  constexpr double kCutoff_Hz = 50.0;
  glm::dvec3& velocity = velocity_D_mm_per_s.xyz;
  if (!(since_s > 0.0)) {
    velocity = glm::dvec3(0.0);
    return;
  }
  const double blend = 1.0 - std::exp(-2.0 * calibration::kPi * kCutoff_Hz * since_s);
  velocity += blend * (moved_D_mm / since_s - velocity);
}

}  // namespace haptics
