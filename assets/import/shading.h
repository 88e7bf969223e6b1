// Flattens cupping and scatter of cone-beam scans: soft tissue should be equally grey everywhere, so its local mean in
// cells of 2.8 mm, smoothed over 14 mm, is subtracted, by at most 300 HU, and its median is moved to 20 HU. Parallel
// (TBB); 1 s for 512^3. Any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// Standard deviation over the volume of what was subtracted, HU; 0 and nothing changed where less than 2 % is soft
/// tissue. `hounsfield`: roughly so, by a linear map.
double flattenShading(const VolumeGrid& grid, std::vector<std::int16_t>& hounsfield);

}  // namespace assets
