// Whether a scan's grey values can be Hounsfield, by what every head has: air at -1000, far less bone than soft tissue,
// no tissue denser than enamel. What is doubtful is said in a line each, for people; nothing is changed. Greys that are
// surely none: assets/scan/grey_window.h. Any thread; a pass over the voxels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// An offset scale; metal and its streaks.
std::vector<std::string> scaleRemarks(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield);

}  // namespace assets
