// What the hand does at one tick, as the servo sees it. Trivially copyable; recorded for replay, so it holds all input.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

struct HandSample {
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;  ///< where the hand holds the tool
  calibration::Vector<calibration::Patient> velocity_P_mm_per_s;    ///< of the tool's origin
  calibration::Vector<calibration::Patient> arm_P_mm;  ///< from there to the point of the handle that the device moves
  bool drill_pedal = false;
  bool device_healthy = true;  ///< false: the force ramps to zero
};

}  // namespace haptics
