// End-to-end check: the screen shows a thin ring where the calibrated arm's tip should be, a webcam at the eye sees
// ring and lit tip, and their distance at the tip's depth is the error of the whole chain: arm, mirror, screen, glass.
// Frames W and C, mm, px. Blind along its own line of sight. Source: reference/calibration 4.4.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

inline constexpr int kRingPlaces = 8;
inline constexpr double kRingLimit_mm = 1.0;  ///< of the mean; reference/calibration 4.4
struct RingDetection {
  std::string line;  ///< why there is no result, and what to do; empty: both were found
  glm::dvec2 ring_px{0.0}, tip_px{0.0};
  double ring_radius_px = 0.0;
};

/// Ring and tip in one image, against one with the screen dark and no tip. Throws CalibrationError for images of
/// different sizes.
RingDetection detectRing(const GreyImage& dark, const GreyImage& with_both);

/// From the ring's centre to the tip, across the line of sight, at the tip's distance from the camera.
Vector<Camera> ringOffset_mm(const CameraModel& camera, const RingDetection& detection, double tip_ahead_mm);

struct RingCheck {
  double mean_mm = 0.0, max_mm = 0.0;
  int worst = 0;  ///< index of the position
  bool passed = false;
  std::string line;  ///< for people
};

/// Throws CalibrationError for fewer than 8 positions.
RingCheck judgedRing(const std::vector<Vector<Camera>>& offsets_mm);

}  // namespace calibration
