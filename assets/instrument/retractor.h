// Minnesota retractor. Own frame: a bent steel ribbon, origin at the tip of the blade, +z along the handle, the blade
// towards +y; x across. mm. One part, "Retractor", closed, with round edges. 150 mm long and 14 mm wide, blade bent by
// about 60 degrees, as usual ones; there is no standard. Any thread; some ms. Drawn only: it holds no tissue.
#pragma once

#include "assets/mesh.h"

namespace assets {

inline constexpr double kRetractorThickness_mm = 1.2;

MeshModel retractor();

}  // namespace assets
