// Whether a scan's grey values can be Hounsfield, by what every head has: air at -1000, far less bone than soft tissue,
// no tissue denser than enamel. What is doubtful is said in a line each, for people; nothing is changed but an 8-bit
// volume whose window is given. Any thread; a pass over the voxels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// What the greys 0 and 255 of an 8-bit volume mean.
struct GreyWindow {
  double low_hu = -1000.0, high_hu = 3000.0;
};

/// Applies the window. Throws LoadError: 8-bit greys (0..255) without a window, or a window for other values.
void scaleGreys(std::vector<std::int16_t>& hounsfield, const std::optional<GreyWindow>& window,
                const std::string& path);

/// An offset scale; metal and its streaks.
std::vector<std::string> scaleRemarks(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield);

}  // namespace assets
