// What is left at each touch as arrows, larger than life, from where the tip was towards where the arm says it was:
// seen from the front (W's x and y) and from the right (W's z and y, the viewer at the left). mm. Pure.
#pragma once

#include <string>
#include <vector>

#include "calibration/fit/arm_fit.h"

namespace app {

/// Inline SVG. `fitted` in grey, what was used against what was set aside told apart; `held_out` in blue.
std::string residualViews(const std::vector<calibration::Residual>& fitted,
                          const std::vector<calibration::Residual>& held_out);

}  // namespace app
