// Continues the mandibular canal where a tooth's root covers its labels: the least bent path between both ends of the
// gap whose wall stays outside the tooth, the best of eight directions of passing. A tooth in the middle of the
// labelled canal leaves no way round; the gap is then straight. Frame P, mm. Any thread; some ms a gap. An estimate for
// the surgeon's distance to the nerve, no segmentation.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// Moves the points of the line that bridge a gap; its first and last two stay. `radius_mm`: of the canal.
void routeAroundTeeth(std::vector<glm::dvec3>& line_P_mm, const std::vector<bool>& is_bridge, double radius_mm,
                      const VolumeGrid& grid, const std::vector<std::uint8_t>& label);

}  // namespace assets
