// Dental elevators as drawn, in frame T: +z along the shaft from the blade to the handle, y the concave face. Straight
// (301, 34S): origin at the blade's tip, x across the blade. Cryer: origin on the shaft's axis level with the tip,
// which lies to the left (-x) or right (+x). mm. The blade is that of haptics/ligament/elevator_shape; shank 35 mm,
// handle 80 mm long and up to 15 mm thick (reference/extraction 5.1, unverified). Parts "Blade", "Shank" and "Handle",
// each closed, some 2,700 triangles. Any thread; under 1 ms. Drawn only: it moves nothing.
#pragma once

#include "assets/mesh.h"

namespace assets {

enum class ElevatorForm { straight_301, straight_34s, cryer_left, cryer_right };

MeshModel elevator(ElevatorForm form);

}  // namespace assets
