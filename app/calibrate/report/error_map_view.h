// The error to be expected over the plane of the screen's image through the site (W's x and y, z = 0), in bands of
// light to dark blue, with where the touches were. mm. Pure.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

using ExpectedError = std::function<double(const calibration::Point<calibration::World>&)>;

std::string errorMapView(const ExpectedError& expected_mm,
                         const std::vector<calibration::Point<calibration::World>>& touches_W);

}  // namespace app
