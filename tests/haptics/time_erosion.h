// Steps of the erosion law that is linear in time, at the speed its rate is stated for.
#pragma once

#include "haptics/bone/erosion_step.h"

namespace haptics::phantom {

inline ErosionStep timeErosion(const ErosionSettings& erosion, double dt_s) {
  CutConditions moment;
  moment.dt_s = dt_s;
  moment.spindle_rad_per_s = erosion.time.rated_rpm * 2.0 * 3.14159265358979323846 / 60.0;
  return erosionStep(erosion, moment, {});
}

}  // namespace haptics::phantom
