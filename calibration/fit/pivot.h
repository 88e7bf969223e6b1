// Where the tip of a new bur or stylus end stands in the handle: its end in one pit, the handle swung about it, so that
// one point of the handle stays where it is. Linear least squares [R | -I] [tip; pit] = -place of the handle. Frames H
// and D, mm. Any thread but the servo's; microseconds. What the gimbal gets wrong goes into the tip: a fit of the whole
// arm with touches (arm_fit) follows. Source of method and limits: reference/calibration 2.5.
#pragma once

#include <vector>

#include "calibration/arm/arm_correction.h"
#include "calibration/calibration_error.h"

namespace calibration {

struct Pivot {
  glm::dvec3 tip_H_mm{0.0};
  Point<Device> pit_D;
  double rms_mm = 0.0;           ///< of the tip's wandering about the pit
  double tilt_spread_deg = 0.0;  ///< between the directions of the handle, 95 of 100 pairs are within it
  double sigma_mm = 0.0;         ///< of the tip, along the axis that is known least
};

inline constexpr std::size_t kMinHolds = 12;
inline constexpr double kMinSwing_deg = 40.0, kMaxPivotRms_mm = 0.3;

/// `holds_rad`: one of each way the handle was held. Throws CalibrationError, one line: fewer than 12, not finite,
/// swung less than 40 degrees or in one plane only, more than 0.3 mm root mean square (it slipped, or the gimbal is
/// off).
Pivot fitPivot(const PhantomGeometry& geometry, const ArmCorrection& correction,
               const std::vector<RawJoints>& holds_rad);

}  // namespace calibration
