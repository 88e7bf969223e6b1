// The path of a surgeon's hand that makes a planned cut: approach from above, strokes back and forth along its line,
// R/8 deeper each pass, pedal down, then retreat. Frame D, mm, s; handle and tool coincide (X_HT = identity). Line 6-10
// mm at 10-15 mm/s: starting values from the surgery (buccal gutter along the crown), not measured.
#pragma once

#include "assets/planned_cut.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/simulated/hand_script.h"

namespace haptics {

struct CuttingMotion {
  glm::dvec3 shaft_P{0.0};       ///< from bur to handle; zero: outward, tilted to the cheek
  double speed_mm_per_s = 12.0;  ///< along the line
  double clearance_mm = 15.0;    ///< of the bur above the bone, before and after
};

class TroughPath {
 public:
  /// Throws DeviceError when the cut is not finite, has no direction, or has sizes that are not positive.
  explicit TroughPath(const assets::PlannedCut& cut, const CuttingMotion& motion = {},
                      const calibration::Pose<calibration::Device, calibration::Patient>& X_DP = {});

  HandTarget at(double t_s) const;
  /// From the first tick to the end of the retreat; afterwards the hand waits above the site.
  double duration_s() const { return approach_s_ + passes_ * pass_s_ + retreat_s_; }

 private:
  assets::PlannedCut cut_;
  CuttingMotion motion_;
  glm::dvec3 middle_D_mm_, outward_, along_;
  glm::dquat rotation_;
  int deepening_passes_ = 0, passes_ = 0;
  double approach_s_ = 0.0, pass_s_ = 0.0, retreat_s_ = 0.0;
};

}  // namespace haptics
