// A canal's line of a way through cells: drawn to the darkness across it, smoothed, as points about a millimetre apart.
// Frame P, mm. Any thread but the servo; some 50 ms.
#pragma once

#include <vector>

#include "assets/segment/half_jaw.h"

namespace assets {

/// Its ends stay where they are, where a person put them.
enum class CanalEnds { drawn, kept };

/// `way_P_mm`: one cell after another, in whatever cells it was found; at least two.
std::vector<glm::dvec3> centredCanal(const HalfJaw& half, const std::vector<glm::dvec3>& way_P_mm, CanalEnds ends);
/// Centres of cells.
std::vector<glm::dvec3> pointsOfWay(const VolumeGrid& cells, const std::vector<std::size_t>& way);

/// Shorter is no canal.
inline constexpr double kLeastCanal_mm = 15.0;
double wayLength_mm(const std::vector<glm::dvec3>& line_P_mm);

}  // namespace assets
