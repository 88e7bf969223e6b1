#include "haptics/device/usb/falcon_force_scale.h"

#include <algorithm>
#include <cmath>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/falcon_protocol.h"

namespace haptics {
namespace {

constexpr double kUnmeasuredPeak_N = 1.0, kMakersPeak_N = 8.0;
constexpr double kUnmeasuredShare = 0.1;  ///< of the motors' range
constexpr double kBeyondMeasured = 3.0;   ///< extrapolation of a linear motor
constexpr double kMaxMisfit = 0.15;

[[noreturn]] void refuse(const std::string& what) {
  throw DeviceError("Falcon's force scale, " + what + ", weigh it again");
}

}  // namespace

FalconForceScale weighed(const FalconForceScale& used, std::span<const ForceReading> readings) {
  if (readings.size() < 3) refuse("fewer than three readings");
  double asked_asked = 0.0, asked_shown = 0.0, max_weighed_N = 0.0;
  for (const ForceReading& reading : readings) {
    if (!std::isfinite(reading.asked_N) || !std::isfinite(reading.shown_N)) refuse("a reading is not a number");
    asked_asked += reading.asked_N * reading.asked_N;
    asked_shown += reading.asked_N * reading.shown_N;
    max_weighed_N = std::max(max_weighed_N, std::abs(reading.shown_N));
  }

  // shown = gain * asked, least squares through no force.
  const double gain = asked_asked > 0.0 ? asked_shown / asked_asked : 0.0;
  if (gain < 0.0) refuse("it pulls where it should push");
  if (!(gain > 0.0)) refuse("the scale showed no force");
  for (const ForceReading& reading : readings)
    if (std::abs(reading.shown_N - gain * reading.asked_N) > kMaxMisfit * max_weighed_N)
      refuse("the readings do not lie on one line");

  FalconForceScale scale = used;
  scale.words_per_Nmm = used.words_per_Nmm / gain;
  scale.max_weighed_N = max_weighed_N;
  check(scale);
  return scale;
}

void check(const FalconForceScale& scale) {
  if (!(scale.words_per_Nmm >= 2.0 && scale.words_per_Nmm <= 50.0))
    refuse("its words per N mm are not between 2 and 50");
  if (!(scale.max_weighed_N == 0.0 || (scale.max_weighed_N >= 0.2 && scale.max_weighed_N <= 10.0)))
    refuse("its heaviest reading is not between 0.2 and 10 N");
}

double falconPeakForce_N(const FalconForceScale& scale) {
  return scale.isWeighed() ? std::min(kBeyondMeasured * scale.max_weighed_N, kMakersPeak_N) : kUnmeasuredPeak_N;
}

int falconMaxWord(const FalconForceScale& scale) {
  return static_cast<int>(kMaxFalconMotorWord * (scale.isWeighed() ? 1.0 : kUnmeasuredShare));
}

double falconPeakTorque_Nmm(const FalconForceScale& scale) { return falconMaxWord(scale) / scale.words_per_Nmm; }

std::string falconForceAdvice(const FalconForceScale& scale) {
  if (scale.isWeighed()) return {};
  return "its newtons are a guess and held to a tenth of its motors' range, weigh it with molar devices check";
}

}  // namespace haptics
