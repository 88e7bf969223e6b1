// The hand at one tick, as safety layer and servo see it. Trivially copyable; recorded with every input of the safety
// layer, so a replay reproduces every trip. Frame P, mm, s, rad.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

struct HandSample {
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;  ///< the tool in the hand
  calibration::Vector<calibration::Patient> velocity_P_mm_per_s;    ///< of the tool's origin
  calibration::Vector<calibration::Patient> arm_P_mm;               ///< from there to the driven point of the handle
  /// Of that point, as measured by the device. Safety uses this: gimbal noise shakes the tool's end.
  calibration::Vector<calibration::Patient> handle_velocity_P_mm_per_s;
  glm::dmat3 jacobian_P_mm{0.0};  ///< of that point by the motor-driven joints, mm/rad; zero where not known
  double motor_heat = 0.0;        ///< of the warmest motor, 0 cold to 1 as warm as allowed
  double gap_s = 0.0;             ///< time since the last tick if longer than 1.5 ticks; else 0
  bool drill_pedal = false;
  bool fresh = true;            ///< measured since the last tick
  bool docked = false;          ///< in its inkwell
  bool held = true;             ///< the deadman detects a hand; true without a deadman
  bool calibrated = true;       ///< the pose is valid
  bool stop_requested = false;  ///< emergency stop: no force from now on
  bool device_healthy = true;   ///< false: the device reports trouble, or is gone
};

}  // namespace haptics
