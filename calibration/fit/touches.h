// Touches: the device's raw joints with the tip at a known target. Frame W, mm, rad. Plain data; any thread.
// touches_file reads and writes them.
#pragma once

#include <string>
#include <vector>

#include "calibration/arm/arm_correction.h"

namespace calibration {

struct Touch {
  int id = 0;  ///< of the target
  RawJoints joints_rad{};
  Point<World> target_W;  ///< true tip position
  bool used = true;       ///< false: set aside by the technician
};

/// One sigma of the tip at a touch. A pit holds the tip from all sides; crosses on the screen are aimed at by eye, less
/// accurately along the line of sight (reference/calibration 2.2, 2.4).
struct TouchPrecision {
  double in_plane_mm = 0.05, along_sight_mm = 0.05;  ///< along W's x and y; along its z
};
inline constexpr TouchPrecision kPitPrecision{0.05, 0.05}, kCrossPrecision{0.3, 1.0};

struct TouchSet {
  std::string device_model = "omni";  ///< key of phantom_models
  std::string serial, mount;          ///< empty: not known
  std::string method;                 ///< "jig27", "visual25", "rezero5", …; empty: not known
  TouchPrecision precision;
  std::vector<Touch> touches;
};

}  // namespace calibration
