// The path of a surgeon's hand that makes a planned cut: approach along the shaft, the plan's strokes one after another
// with the pedal down, then retreat. From one stroke to the next it goes straight where they meet, over the bone where
// they do not. Frame D, mm, s; handle and tool coincide (X_HT = identity). 10-15 mm/s along a stroke: a starting value
// from the surgery (buccal gutter along the crown), not measured. A pure function of time; no allocation after
// construction.
#pragma once

#include <vector>

#include "assets/planned_cut.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/simulated/hand_script.h"

namespace haptics {

struct CuttingMotion {
  glm::dvec3 shaft_P{0.0};       ///< from bur to handle; zero: outward, tilted to the cheek, in and out along outward
  double speed_mm_per_s = 12.0;  ///< mean along a stroke
  double travel_mm_per_s = 40.0, approach_mm_per_s = 13.0;  ///< mean; over the bone; in and out
  double clearance_mm = 15.0;                               ///< of the bur above the bone, before and after
};

class TroughPath {
 public:
  /// Throws DeviceError when the cut is not finite, has no stroke or direction, or has sizes that are not positive.
  explicit TroughPath(const assets::PlannedCut& cut, const CuttingMotion& motion = {},
                      const calibration::Pose<calibration::Device, calibration::Patient>& X_DP = {});

  HandTarget at(double t_s) const;
  /// From the first tick to the end of the retreat; afterwards the hand waits above the site.
  double duration_s() const { return begins_s_.back(); }

 private:
  void go(const glm::dvec3& to_mm, double speed_mm_per_s);
  void work(const std::vector<glm::dvec3>& stroke_mm, double speed_mm_per_s);

  /// Leg n begins at begins_s_[n] and goes along the corners from first_[n] to first_[n + 1].
  std::vector<double> begins_s_;
  std::vector<std::size_t> first_;
  std::vector<glm::dvec3> corner_mm_;
  std::vector<double> way_mm_;  ///< from the beginning of its leg to each corner
  glm::dquat rotation_;
  double pedal_from_s_ = 0.0, pedal_to_s_ = 0.0;
};

}  // namespace haptics
