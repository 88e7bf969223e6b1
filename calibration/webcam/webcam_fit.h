// From a camera at the eye to a measured arm, without a jig: one bundle adjustment over where the camera stood (two
// positions or more), where the device stands (X_WD) and the arm's numbers, under the same priors as arm_fit. What is
// seen: the screen's pattern, which is W, and the lit tip at touches whose raw joints are known. Frame W, mm, rad, px.
// Any thread but the servo's; under 1 s. Not for a single camera position: along its line of sight it guesses.
// Source: reference/calibration 2.3; start by solvePnP (IPPE for the screen, SQPNP for the tip).
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_fit.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// A place on the virtual screen (z = 0) and where it is seen.
struct PlaceSight {
  Point<World> place_W;
  glm::dvec2 camera_px{0.0};
};

/// A touch as the camera sees it: what the sensors read and where the tip is in the picture.
struct TipSight {
  int id = 0;  ///< of the target
  RawJoints joints_rad{};
  glm::dvec2 camera_px{0.0};
};

struct CameraPosition {
  std::vector<PlaceSight> screen;
  std::vector<TipSight> tips;
};

struct WebcamSights {
  CameraModel camera;
  std::string device_model = "omni";  ///< key of phantom_models
  double screen_noise_px = 0.25, tip_noise_px = 0.5;
  std::vector<CameraPosition> positions;
};

struct WebcamFit {
  ArmModel model = ArmModel::full;
  MeasuredArm arm;
  std::vector<Pose<World, Camera>> X_WC;         ///< of each position
  double screen_rms_px = 0.0, tip_rms_px = 0.0;  ///< over what was used
  std::vector<std::vector<bool>> tip_used;       ///< of each position's tips; false: an outlier
  int used = 0, outliers = 0;
  std::vector<FitWarning> warnings;
  double tilt_spread_deg = 0.0;
  int iterations = 0;
};

/// Throws CalibrationError for fewer than 2 camera positions, fewer than 16 tips in all, fewer than 4 places of the
/// screen at a position, positions in one place, numbers not finite, an unknown model, or sights that no pose explains.
WebcamFit fitWebcam(const WebcamSights& sights, ArmModel model = ArmModel::full);

/// What a single camera position makes of it, with the arm as its model says: where fitWebcam starts, and how far off
/// one position alone would be. Same errors, for one position.
MeasuredArm armFromOnePosition(const WebcamSights& sights, std::size_t position);

}  // namespace calibration
