// The way of a surgeon's hand: cuts a buccal trough beside an impacted third molar. Comes down from above, sweeps back
// and forth along the buccal side of the crown, R/8 deeper every pass, pedal down, and withdraws. Frame D, mm, s;
// handle and tool are one (X_HT = identity). Stroke 6-10 mm at 10-15 mm/s: starting values from the surgery itself
// (buccal gutter along the crown), not measured. Not the hand itself (device/simulated).
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/simulated/hand_script.h"

namespace haptics {

struct TroughPlan {
  calibration::Point<calibration::Device> site_D;      ///< middle of the trough, on the bone's surface
  calibration::Vector<calibration::Device> outward_D;  ///< out of the bone, where the bur comes from
  calibration::Vector<calibration::Device> buccal_D;   ///< across the trough, away from the tooth
  calibration::Vector<calibration::Device> shaft_D;    ///< from bur to handle; zero: outward, tilted to the cheek
  double bur_radius_mm = 2.0;
  double stroke_mm = 8.0;        ///< length of a sweep, 6..10
  double speed_mm_per_s = 12.0;  ///< along the sweep
  double depth_mm = 4.0;         ///< how far the bur's lowest point goes below the surface
  double clearance_mm = 15.0;    ///< height of the bur above the bone before and after
};

class TroughPath {
 public:
  /// Throws DeviceError when the plan is not finite, has no direction, or has sizes that are not positive.
  explicit TroughPath(const TroughPlan& plan);

  HandTarget at(double t_s) const;
  /// From the first tick to the end of the retreat; afterwards the hand waits above the site.
  double duration_s() const { return approach_s_ + passes_ * pass_s_ + retreat_s_; }

 private:
  TroughPlan plan_;
  glm::dvec3 outward_, along_;
  glm::dquat rotation_;
  int deepening_passes_ = 0, passes_ = 0;
  double approach_s_ = 0.0, pass_s_ = 0.0, retreat_s_ = 0.0;
};

}  // namespace haptics
