// What the hand does at one tick, as safety layer and servo see it. Trivially copyable; recorded for replay, so it
// holds every input there is, the safety layer's too: a replay proves every trip. Frame P, mm, s, rad.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

struct HandSample {
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;  ///< where the hand holds the tool
  calibration::Vector<calibration::Patient> velocity_P_mm_per_s;    ///< of the tool's origin
  calibration::Vector<calibration::Patient> arm_P_mm;  ///< from there to the point of the handle that the device moves
  /// Of that point, as the device measures it: what is safe goes by this, for a gimbal's noise shakes the tool's end.
  calibration::Vector<calibration::Patient> handle_velocity_P_mm_per_s;
  glm::dmat3 jacobian_P_mm{0.0};  ///< of that point by the motor-driven joints, mm/rad; zero where not known
  double motor_heat = 0.0;        ///< of the warmest motor, 0 cold to 1 as warm as allowed
  double gap_s = 0.0;             ///< by the clock since the tick before, where longer than a tick should take; else 0
  bool drill_pedal = false;
  bool fresh = true;            ///< measured since the last tick
  bool docked = false;          ///< in its inkwell
  bool held = true;             ///< the deadman feels a hand; true where there is none
  bool calibrated = true;       ///< the pose can be believed
  bool stop_requested = false;  ///< emergency stop: no force from now on, for good
  bool device_healthy = true;   ///< false: the device reports trouble, or is gone
};

}  // namespace haptics
