// Observations of a webcam at the eye: the screen and the lit tip from each camera position. Frame W, px, rad. Plain
// data; any thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/arm/arm_correction.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// A point on the virtual screen (z = 0) and its pixel.
struct ScreenObservation {
  Point<World> position_W;
  glm::dvec2 camera_px{0.0};
};

/// A touch seen by the camera: raw joints and the tip's pixel.
struct TipObservation {
  int id = 0;  ///< of the target
  RawJoints joints_rad{};
  glm::dvec2 camera_px{0.0};
};

struct CameraPosition {
  std::vector<ScreenObservation> screen;
  std::vector<TipObservation> tips;
};

struct WebcamObservations {
  CameraModel camera;
  std::string device_model = "omni";                  ///< key of phantom_models
  std::string serial{}, mount{};                      ///< of the device; empty: not known
  double screen_noise_px = 0.25, tip_noise_px = 0.5;  ///< one sigma, an axis
  std::vector<CameraPosition> positions{};
};

}  // namespace calibration
