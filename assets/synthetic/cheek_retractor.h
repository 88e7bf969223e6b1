// Minnesota cheek retractor: a bent steel ribbon with its blade inside the cheek. Frame of the mandible with the
// operated side at +x (face_frames.h), mm. Some ms. Blade 13 mm wide, 1.2 mm thick.
#pragma once

#include "assets/mesh.h"
#include "assets/synthetic/mouth_rim.h"

namespace assets {

/// Around the rim's retracted corner.
MeshPart cheekRetractor(const MouthRim& rim);

}  // namespace assets
