// Text on how to tilt a stylus. Unit directions from the tip to the handle, frame W (x right, y up, z to the viewer).
// Pure; any thread.
#pragma once

#include <string>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

double angleBetween_deg(const glm::dvec3& a, const glm::dvec3& b);

/// "lean the handle 20° to the left and 12° up"; empty below 5° each way.
std::string tiltText(const calibration::Vector<calibration::World>& present_W,
                     const calibration::Vector<calibration::World>& wanted_W);

}  // namespace app
