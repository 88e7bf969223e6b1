// How the mandibular canal goes on where a tooth's root hides it from its labels: the least bent way on from both sides
// that keeps its wall out of the tooth. Of eight sides to pass by the one that bends least is taken; straight across,
// the line ran through the root, 1.8 mm off. A tooth that stands in the middle of what is labelled leaves no way to
// pass: then straight across. Frame P, mm. Any thread; some milliseconds a gap. A guess, made for a surgeon's distance
// to the nerve: no segmentation.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// Moves the points of `line` that bridge a gap; the first and the last two of the line stay. `radius_mm`: the canal's.
void routeAroundTeeth(std::vector<glm::dvec3>& line_P_mm, const std::vector<bool>& is_bridge, double radius_mm,
                      const VolumeGrid& grid, const std::vector<std::uint8_t>& label);

}  // namespace assets
