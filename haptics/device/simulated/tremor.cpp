#include "haptics/device/simulated/tremor.h"

#include <cmath>

#include "calibration/random.h"

namespace haptics {
namespace {

constexpr double kSlowest_Hz = 8.0, kFastest_Hz = 12.0;

}  // namespace

// The mean square of a wave is half its height squared; they add up.
Tremor::Tremor(double rms_mm, std::uint32_t seed) : height_mm_(rms_mm * std::sqrt(2.0 / (3.0 * kWaves))) {
  std::mt19937 random(seed);
  for (auto& axis : waves_)
    for (Wave& wave : axis)
      wave = {2.0 * calibration::kPi * calibration::uniform(random, kSlowest_Hz, kFastest_Hz),
              calibration::uniform(random, 0.0, 2.0 * calibration::kPi)};
}

glm::dvec3 Tremor::at(double t_s) const {
  glm::dvec3 away(0.0);
  for (int axis = 0; axis < 3; ++axis)
    for (const Wave& wave : waves_[static_cast<std::size_t>(axis)])
      away[axis] += height_mm_ * std::sin(wave.rad_per_s * t_s + wave.phase_rad);
  return away;
}

}  // namespace haptics
