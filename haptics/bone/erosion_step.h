// What a bur takes in one step, as the erosion law of the moment has worked it out from force, speed and spindle.
// Trivially copyable; servo thread. The step itself knows nothing of the law (bone/carve carries it out).
#pragma once

#include <array>

#include "assets/tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

struct ErosionStep {
  /// Fraction of its first content that a fully covered voxel of each tissue loses in this step, 0..1.
  std::array<double, assets::kTissueCount> loss{};
  /// Share of the loss that goes with the sliding speed of the bur's surface, |r x axis|: 0 everywhere alike, 1 none at
  /// the tip of a turning bur.
  double speed_share = 0.0;
  calibration::Vector<calibration::Patient> axis_P{{0.0, 0.0, 1.0}};  ///< of the spindle, unit
  double mean_arm_mm = 1.0;  ///< mean |r x axis| over the cut, so that the speed share changes where, not how much
};

}  // namespace haptics
