// The strokes that cut a gutter from a height map: level by level from the top, row by row along the crown, to and fro,
// then along the bottom while the bone gives way. Frame P, mm. Any thread; some ms.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "app/case/height_map.h"

namespace app {

/// For a bur that cuts with its ball: a longer head takes more in a pass.
struct StrokePlan {
  double level_mm = 0.5;     ///< depth of one pass
  int finishing_passes = 2;  ///< along the bottom
};

/// `planned`: 1 for the columns to be cut, in the order of the map. Strokes of the bur's centre in the order of the
/// work.
std::vector<std::vector<glm::dvec3>> gutterStrokes(const WayIn& way, const Heights& heights,
                                                   const std::vector<char>& planned, const StrokePlan& plan = {});

}  // namespace app
