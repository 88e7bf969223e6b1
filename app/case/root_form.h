// Roots of a tooth, counted and described from its cross-sections: slices across the long axis below the cervical line
// fall into as many parts as there are roots. Frame P, mm. Any thread; some 10 ms. Roots that merge again before their
// ends count by the slices in which they are apart; a root that is never apart is not told from a fused one.
#pragma once

#include <optional>

#include "app/case/tooth_voxels.h"

namespace app {

struct RootForm {
  int count = 1;            ///< parts over at least 2 mm of the roots' length
  double length_mm = 0.0;   ///< cervical line to the lowest end
  double furcation_mm = 0;  ///< cervical line to where they part; 0 for one root
  double bend_deg =
      0.0;  ///< of the root that is bent most, from its neck to its end against the axis; to distal positive
  double spread_mm = 0.0;  ///< the outer roots' distance at their ends, less that where they part
};

/// None below 3 mm of root. `mesial_P`: unit.
std::optional<RootForm> rootForm(const ToothVoxels& tooth, const glm::dvec3& axis_P, const glm::dvec3& mesial_P,
                                 double voxel_mm);

}  // namespace app
