// One least-squares problem over all that a webcam at the eye saw: where the camera stood each time, the arm's
// parameters under their priors, and the little by which the lens is not what was measured (focal length, centre). Wild
// sights lose their say. Slopes are analytic. Frames W, C; mm, rad, px. Any thread but the servo's; 600 to 6,000
// residuals and 49 parameters take 10 to 200 ms. Not the start, not the naming of outliers (webcam_fit).
#pragma once

#include <vector>

#include "calibration/fit/arm_parameters.h"
#include "calibration/webcam/camera.h"
#include "calibration/webcam/webcam_observations.h"

namespace calibration {

struct WebcamBundle {
  ArmStart start;
  std::vector<std::size_t> fitted;  ///< of kArmParameters
  ArmParameters parameters{};
  ArmParameters sigma{};  ///< 1 sigma of those fitted, 0 of the others
  CameraModel camera;     ///< as adjusted
  std::vector<Pose<Camera, World>> X_CW;
  std::vector<std::vector<bool>> tip_used;  ///< of each position's tips
  double mismatch_mm = 0.25;  ///< one sigma, an axis across the line of sight: of tips, beyond their noise in the image
  double effective_arm_parameters = 0.0;  ///< how many of the arm's parameters the tips, not the priors, decided
  int iterations = 0;

  MeasuredArm arm() const { return armOf(start, parameters); }
};

/// The most probable parameters, from those of the bundle given; its mismatch as it is.
WebcamBundle adjusted(const WebcamObservations& sights, const WebcamBundle& from);

/// Of a tip's sight, px, an axis: its noise and the mismatch as it looks from there.
double tipSigma_px(const WebcamObservations& sights, const WebcamBundle& bundle, std::size_t position,
                   const Point<World>& tip_W);

}  // namespace calibration
