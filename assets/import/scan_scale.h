// Checks whether grey values can be Hounsfield, by properties of every head: air at -1000, far less bone than soft
// tissue, no tissue denser than enamel. Returns warnings for the user; changes nothing. 8-bit grey values:
// scan/grey_window.h. Any thread; one pass.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// An offset scale; metal with its streaks.
std::vector<std::string> scaleRemarks(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield);

}  // namespace assets
