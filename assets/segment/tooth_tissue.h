// Enamel, dentine and pulp of teeth by grey value: enamel above halfway from dentine to the tooth's brightest, pulp
// below half of dentine and inside. A voxel of the surface is divided between tooth and surroundings, so it takes the
// tissue of the nearest voxel behind it. The rest of the jaw is cortical or trabecular bone. Any thread but the servo;
// 1 s of CPU for a whole jaw at 0.35 mm.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/segment/tooth_regions.h"

namespace assets {

/// Tissue values in the box of `teeth`; 0 outside them.
std::vector<std::uint8_t> tissuesOfTeeth(const Mandible& jaw, const ToothRegions& teeth, const GreyLevels& levels);

}  // namespace assets
