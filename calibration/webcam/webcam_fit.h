// Fits a measured arm from a camera at the eye, without a jig: one bundle adjustment over camera poses (two positions
// or more), the device pose X_WD and the arm's parameters, under the priors of arm_fit. Observed are the screen's
// pattern, which defines W, and the lit tip at touches with known raw joints. Frame W, mm, rad, px. Any thread but the
// servo's; under 1 s. A single position leaves the depth undetermined. Source: reference/calibration 2.3; start by
// solvePnP (IPPE for the screen, SQPNP for the tip).
#pragma once

#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_fit.h"
#include "calibration/webcam/webcam_observations.h"

namespace calibration {

struct WebcamFit {
  ArmModel model = ArmModel::full;
  MeasuredArm arm;
  CameraModel camera;                            ///< lens as adjusted
  std::vector<Pose<World, Camera>> X_WC;         ///< per position
  double screen_rms_px = 0.0, tip_rms_px = 0.0;  ///< of those used
  /// Per tip, position by position: tip by the arm minus the nearest point on the line of sight. Depth is not observed:
  /// two of three axes.
  std::vector<Residual> residuals;
  std::vector<FitWarning> warnings;
  int used = 0, outliers = 0;
  double fre_rms_mm = 0.0;  ///< of the residuals, scaled to three axes
  double cv_rms_mm = 0.0;   ///< cross-validated (5-fold), as above, without the tips' image noise
  double tilt_spread_deg = 0.0;
  double baseline_deg = 0.0;  ///< widest angle between two camera positions, from the centre of the tips
  int iterations = 0;
  std::vector<double> sigma;  ///< as in ArmFit
};

/// Throws CalibrationError for fewer than 2 camera positions, all within 5°, fewer than 16 tips in all or 4 at a
/// position, fewer than 6 screen points at a position, a mirrored screen, numbers not finite, an unknown model, or
/// observations that no pose of the arm explains.
WebcamFit fitWebcam(const WebcamObservations& observations, ArmModel model = ArmModel::full);

}  // namespace calibration
