// P9: the form of a class I or II cavity: depth, isthmus, divergence of its walls, the box, and enamel that no dentine
// bears (reference/sisters 5.3). Walls are walked to from the middle of the groove; a wall lies where the sum of the
// solid along the ray says. Where the groove was meant to be a rule says, or the ideal itself, seen from the bite.
// Frame of the tooth, mm, rad. Pure; any thread; some 0.1 s.
#pragma once

#include <optional>

#include "app/procedure/preparation/prepared_ideal.h"

namespace app {

struct CavityForm {
  double depth_mm = 0.0, least_depth_mm = 0.0, most_depth_mm = 0.0;  ///< below the intact surface, along the groove
  double isthmus_mm = 0.0, least_isthmus_mm = 0.0;                   ///< from cheek to tongue, half-way down
  double length_mm = 0.0;                                            ///< from mesial to distal, half-way down
  double divergence_rad = 0.0;  ///< of the walls of cheek and tongue, positive: wider towards the bite
  double box_axial_mm = 0.0, box_width_mm = 0.0, box_height_mm = 0.0;  ///< class II; height of its floor
  double unsupported_mm2 = 0.0;  ///< of cut enamel with no dentine within 1.5 mm behind it

  bool isCut() const { return depth_mm > 0.0; }
};

/// The cavity that an ideal is: its groove, what is wanted of it, and a box at one side (of two the larger one). None:
/// it has no two walls along a floor, as an onlay.
std::optional<IdealRule> cavityRuleOf(const Crown& crown, const BoxBytes& ideal);

CavityForm cavityForm(const Crown& crown, const BoxBytes& made, const IdealRule& rule);

}  // namespace app
