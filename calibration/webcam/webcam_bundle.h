// One least-squares problem over all that a webcam at the eye saw: where the camera stood each time, the arm's numbers
// under their priors, and the little by which the lens is not what was measured (focal length, centre). Wild sights
// lose their say. Slopes are analytic. Frames W, C; mm, rad, px. Any thread but the servo's; 600 to 6,000 residuals and
// 49 numbers take 10 to 200 ms. Not the start, not the naming of outliers (webcam_fit).
#pragma once

#include <vector>

#include "calibration/fit/arm_numbers.h"
#include "calibration/webcam/camera.h"
#include "calibration/webcam/sights.h"

namespace calibration {

struct WebcamBundle {
  ArmStart start;
  std::vector<std::size_t> fitted;  ///< of kArmParameters
  ArmNumbers numbers{};
  ArmNumbers sigma{};  ///< 1 sigma of those fitted, 0 of the others
  CameraModel camera;  ///< as adjusted
  std::vector<Pose<Camera, World>> X_CW;
  std::vector<std::vector<bool>> tip_used;  ///< of each position's tips
  double mismatch_mm =
      0.25;               ///< one sigma, an axis across the line of sight: of tips, beyond their noise in the picture
  double arm_said = 0.0;  ///< how many of the arm's numbers the tips, not the priors, decided
  int iterations = 0;

  MeasuredArm arm() const { return armOf(start, numbers); }
};

/// The most probable numbers, from those of the bundle given; its mismatch as it is.
WebcamBundle adjusted(const WebcamSights& sights, const WebcamBundle& from);

/// Of a tip's sight, px, an axis: its noise and the mismatch as it looks from there.
double tipSigma_px(const WebcamSights& sights, const WebcamBundle& bundle, std::size_t position,
                   const Point<World>& tip_W);

}  // namespace calibration
