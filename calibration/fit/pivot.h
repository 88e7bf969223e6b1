// Pivot calibration of a new bur or stylus end: its end in one pit, the handle swung about it. Linear least squares [R
// -I] [tip; pit] = -position of the handle. Frames H and D, mm. Any thread but the servo's; microseconds. Gimbal errors
// go into the tip, so a fit of the whole arm (arm_fit) should follow. Method and limits: reference/calibration 2.5.
#pragma once

#include <vector>

#include "calibration/arm/arm_correction.h"
#include "calibration/calibration_error.h"

namespace calibration {

struct Pivot {
  glm::dvec3 tip_H_mm{0.0};
  Point<Device> pit_D;
  double rms_mm = 0.0;           ///< of the tip about the pit
  double tilt_spread_deg = 0.0;  ///< 95th percentile of the angles between pairs of handle directions
  double sigma_mm = 0.0;         ///< of the tip, along its least certain axis
};

inline constexpr std::size_t kMinHolds = 12;
inline constexpr double kMinSwing_deg = 40.0, kMaxPivotRms_mm = 0.3;

/// `holds_rad`: one for each way of holding the handle. Throws CalibrationError: fewer than 12, not finite, swung less
/// than 40 degrees or in one plane only, more than 0.3 mm RMS (it slipped, or the gimbal is off).
Pivot fitPivot(const PhantomGeometry& geometry, const ArmCorrection& correction,
               const std::vector<RawJoints>& holds_rad);

}  // namespace calibration
