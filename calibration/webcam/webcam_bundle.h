// Bundle adjustment of all observations of a webcam at the eye: camera poses, the arm's parameters under their priors,
// and small corrections of the lens (focal length, centre). Robust to outliers; analytic Jacobian. Frames W, C; mm,
// rad, px. Any thread but the servo's; 600 to 6,000 residuals and 49 parameters take 10 to 200 ms. Start values and
// outlier rejection are webcam_fit's.
#pragma once

#include <vector>

#include "calibration/fit/arm_parameters.h"
#include "calibration/webcam/camera.h"
#include "calibration/webcam/webcam_observations.h"

namespace calibration {

struct WebcamBundle {
  ArmStart start;
  std::vector<std::size_t> fitted;  ///< indices in ArmParameters
  ArmParameters parameters{};
  ArmParameters sigma{};  ///< 1 sigma of the fitted ones, 0 of the others
  CameraModel camera;     ///< as adjusted
  std::vector<Pose<Camera, World>> X_CW;
  std::vector<std::vector<bool>> tip_used;  ///< per position
  /// one sigma, an axis across the line of sight: model error of tips beyond their image noise
  double mismatch_mm = 0.25;
  double effective_arm_parameters = 0.0;  ///< parameters of the arm that the tips rather than the priors determine
  int iterations = 0;

  MeasuredArm arm() const { return armOf(start, parameters); }
};

/// The optimum from a given bundle, with its mismatch fixed.
WebcamBundle adjusted(const WebcamObservations& observations, const WebcamBundle& from);

/// One sigma of a tip's pixel, per axis: image noise and mismatch at its distance.
double tipSigma_px(const WebcamObservations& observations, const WebcamBundle& bundle, std::size_t position,
                   const Point<World>& tip_W);

}  // namespace calibration
