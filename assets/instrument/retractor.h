// A retractor of the Minnesota kind as it is drawn, in its own frame: a bent steel ribbon, origin at the tip of the
// blade, +z along the handle, the blade in between towards +y; x across. mm. One part, "Retractor", a closed surface
// with round edges. Sizes as usual ones have, 150 mm long and 14 mm wide with a blade bent by about 60 degrees; no
// standard says. Any thread; some ms. It holds no tissue: it is seen, not felt.
#pragma once

#include "assets/mesh.h"

namespace assets {

inline constexpr double kRetractorThickness_mm = 1.2;

MeshModel retractor();

}  // namespace assets
