// A cheek retractor of the Minnesota kind: a bent steel ribbon whose blade lies inside the cheek and whose handle leads
// away. Frame of the mandible with the operated side at +x (face_frames.h), mm. Some ms. Blade 13 mm wide, 1.2 mm
// thick.
#pragma once

#include "assets/mesh.h"
#include "assets/synthetic/mouth_rim.h"

namespace assets {

/// Hooked round the rim's retracted corner.
MeshPart cheekRetractor(const MouthRim& rim);

}  // namespace assets
