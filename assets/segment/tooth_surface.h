// The surfaces of teeth where the grey value changes most: a watershed of its gradient between the regions without
// their outermost voxels and what lies more than 0.8 mm outside. A threshold is biased at crowns (the level half-way to
// air is lower there). Any thread but the servo; 2 s of CPU for a whole jaw at 0.35 mm.
#pragma once

#include "assets/segment/tooth_regions.h"

namespace assets {

/// Moves the surfaces of `teeth`; its box may grow.
void moveToEdges(const Mandible& jaw, ToothRegions& teeth);

}  // namespace assets
