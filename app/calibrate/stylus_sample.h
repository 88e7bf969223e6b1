// State of the stylus at one tick, the only input of the calibration, with its time. Frame D, mm, rad, s of any steady
// clock. Plain data; any thread.
#pragma once

#include "calibration/arm/arm_correction.h"

namespace app {

struct StylusSample {
  double t_s = 0.0;
  calibration::RawJoints raw_rad{};
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;  ///< by the device's own model
  bool button = false;                                               ///< the first
  bool valid = false;                                                ///< healthy, calibrated, its pose a pose
  bool docked = false;                                               ///< in its inkwell
};

}  // namespace app
