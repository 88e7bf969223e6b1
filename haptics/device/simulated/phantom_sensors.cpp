#include "haptics/device/simulated/phantom_sensors.h"

#include <cmath>

#include "calibration/geometry/units.h"
#include "calibration/random.h"

namespace haptics {
namespace {

constexpr double kTurn_rad = 2.0 * calibration::kPi;

glm::dvec3 counted(const glm::dvec3& angles_rad, double counts_per_turn) {
  if (!(counts_per_turn > 0.0)) return angles_rad;
  return glm::round(angles_rad * (counts_per_turn / kTurn_rad)) * (kTurn_rad / counts_per_turn);
}

}  // namespace

/// Beyond the limits of the arm the last angles stand.
calibration::PhantomJoints PhantomSensors::sensed(const calibration::PhantomJoints& truth) noexcept {
  if (!untrue_) return truth;
  const auto raw_rad = untrue_->rawAt(handlePose(geometry_, truth));
  if (raw_rad)
    for (int axis = 0; axis < 3; ++axis) {
      last_sensed_.arm_rad[axis] = (*raw_rad)[static_cast<std::size_t>(axis)];
      last_sensed_.wrist_rad[axis] = (*raw_rad)[static_cast<std::size_t>(axis + 3)];
    }
  return last_sensed_;
}

double PhantomSensors::readPotentiometer(double angle_rad) noexcept {
  if (!(sensing_.levels_per_turn > 0.0)) return angle_rad;
  const double level_rad = kTurn_rad / sensing_.levels_per_turn;
  return std::round(angle_rad / level_rad + calibration::uniform(noise_, -0.5, 0.5)) * level_rad;
}

PhantomSensors::Reading PhantomSensors::read(const calibration::PhantomJoints& truth,
                                             const glm::dvec3& true_velocity_mm_per_s, double dt_s) noexcept {
  const calibration::PhantomJoints there = sensed(truth);
  calibration::PhantomJoints seen;
  seen.arm_rad = counted(there.arm_rad, sensing_.counts_per_turn);
  for (int axis = 0; axis < 3; ++axis) seen.wrist_rad[axis] = readPotentiometer(there.wrist_rad[axis]);

  Reading reading;
  for (int axis = 0; axis < 3; ++axis) {
    reading.joints_rad[static_cast<std::size_t>(axis)] = seen.arm_rad[axis];
    reading.joints_rad[static_cast<std::size_t>(axis + 3)] = seen.wrist_rad[axis];
  }
  reading.X_DH = handlePose(geometry_, seen);
  reading.jacobian_D_mm = armJacobian_mm(geometry_, seen.arm_rad);
  if (sensing_.velocity_cutoff_Hz > 0.0) {
    const glm::dvec3 position_mm = reading.X_DH.translation_mm;
    const glm::dvec3 difference = has_last_ && dt_s > 0.0 ? (position_mm - last_mm_) / dt_s : glm::dvec3(0.0);
    velocity_mm_per_s_ +=
        -std::expm1(-kTurn_rad * sensing_.velocity_cutoff_Hz * dt_s) * (difference - velocity_mm_per_s_);
    last_mm_ = position_mm;
    has_last_ = true;
    reading.velocity_D_mm_per_s.xyz = velocity_mm_per_s_;
  } else {
    reading.velocity_D_mm_per_s.xyz = true_velocity_mm_per_s;
  }
  return reading;
}

}  // namespace haptics
