// What a webcam at the eye saw of the screen and of the lit tip, from each place where it stood. Frame W, px, rad.
// Plain data; any thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/arm/arm_correction.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// A place on the virtual screen (z = 0) and where it is seen.
struct ScreenObservation {
  Point<World> position_W;
  glm::dvec2 camera_px{0.0};
};

/// A touch as the camera sees it: what the sensors read and where the tip is in the image.
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
  double screen_noise_px = 0.25, tip_noise_px = 0.5;  ///< one sigma, an axis
  std::vector<CameraPosition> positions;
};

}  // namespace calibration
