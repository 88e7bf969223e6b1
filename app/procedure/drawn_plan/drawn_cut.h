// How what was removed lies to a line that was drawn before: both are seen along the way into the bone, as the surgeon
// sees them, so that depth does not count. Frame P, mm. Pure; a voxel that was removed against every piece of the line,
// some ten ms a rehearsal; allocates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/session/drawn_plan_event.h"
#include "assets/volume_grid.h"

namespace app {

/// Our defaults: half a round bur of 3 mm beside the line, and as much again; half a bur of 2 mm for the section.
inline constexpr double kBesideTrough_mm = 3.0, kBesideSection_mm = 2.0;
/// Removed so near to the side, it follows the line there.
inline constexpr double kFollows_mm = 0.75;

/// `line_P_mm`: two points or more. `outward_P`: not zero. `before` and `after` in the order of the grid.
DrawnCut drawnCut(const std::vector<glm::dvec3>& line_P_mm, const glm::dvec3& outward_P, double beside_mm,
                  const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                  std::span<const std::uint8_t> after);

}  // namespace app
