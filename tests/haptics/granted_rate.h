// mm3/s that an erosion law grants in untouched bone if all that is cut were one tissue: what its step takes of every
// voxel, times the overlap.
#pragma once

#include "haptics/bone/erosion_step.h"

namespace haptics {

inline double grantedRate_mm3_per_s(const ErosionSettings& settings, const CutConditions& moment,
                                    assets::Tissue tissue) {
  return erosionStep(settings, moment, {}).loss[static_cast<std::size_t>(tissue)] * moment.overlap_mm3 / moment.dt_s;
}

}  // namespace haptics
