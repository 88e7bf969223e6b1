// What a long bur would take away along a planned cut, tried on a copy. Frame P, mm. Any thread; some tens of ms for a
// section; pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/planned_cut.h"
#include "assets/volume_grid.h"

namespace app {

inline constexpr double kCuttingHead_mm = 6.0;  ///< of the bur's length that cuts, at least

/// Where the ball at its end stands while it follows the strokes, kSweepStep_mm apart at most.
std::vector<glm::dvec3> placesAlong_P_mm(const assets::PlannedCut& cut);
inline constexpr double kSweepStep_mm = 0.2;

/// Takes it out of `solid`, in the order of the grid: a little less than the bur's radius, as it is held up by what it
/// cuts.
void sweep(const assets::PlannedCut& cut, const assets::VolumeGrid& grid, std::span<std::uint8_t> solid);

}  // namespace app
