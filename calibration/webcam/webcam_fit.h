// From a camera at the eye to a measured arm, without a jig: one bundle adjustment over where the camera stood (two
// positions or more), where the device stands (X_WD) and the arm's numbers, under the same priors as arm_fit. What is
// seen: the screen's pattern, which is W, and the lit tip at touches whose raw joints are known. Frame W, mm, rad, px.
// Any thread but the servo's; under 1 s. Not for a single camera position: along its line of sight it guesses.
// Source: reference/calibration 2.3; start by solvePnP (IPPE for the screen, SQPNP for the tip).
#pragma once

#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_fit.h"
#include "calibration/webcam/webcam_observations.h"

namespace calibration {

struct WebcamFit {
  ArmModel model = ArmModel::full;
  MeasuredArm arm;
  CameraModel camera;                            ///< as adjusted: the lens is measured again by the way
  std::vector<Pose<World, Camera>> X_WC;         ///< of each position
  double screen_rms_px = 0.0, tip_rms_px = 0.0;  ///< over what was used
  /// Of every tip, position after position: where the arm says it was, less the nearest place on the line of sight.
  /// Nothing is known along that line: two of three axes.
  std::vector<Residual> residuals;
  std::vector<FitWarning> warnings;
  int used = 0, outliers = 0;
  double fre_rms_mm = 0.0;  ///< of the residuals, taken up to three axes
  double cv_rms_mm = 0.0;   ///< foretold for places not touched (5-fold): as above, less the tips' noise in the image
  double tilt_spread_deg = 0.0;
  double baseline_deg = 0.0;  ///< the widest angle between two camera positions, from the middle of the tips
  int iterations = 0;
  std::vector<double> sigma;  ///< as ArmFit has it
};

/// Throws CalibrationError for fewer than 2 camera positions, all of them within 5°, fewer than 16 tips in all or 4 at
/// a position, fewer than 6 places of the screen at a position, the screen seen mirrored, numbers not finite, an
/// unknown model, or sights that no pose of the arm explains.
WebcamFit fitWebcam(const WebcamObservations& sights, ArmModel model = ArmModel::full);

/// What a single camera position makes of it, with the arm as its model says: where fitWebcam starts, and how far off
/// one position alone would be. Same errors, for that position.
MeasuredArm armFromOnePosition(const WebcamObservations& sights, std::size_t position);

}  // namespace calibration
