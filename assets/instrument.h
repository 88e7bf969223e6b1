// The straight surgical handpiece with a round carbide bur, as it is drawn in frame T: origin at the centre of the
// cutting head, +z along the shaft away from the tip, mm.
// Parts "Bur" (turns about z) and "Handpiece" (stands still). The blades reach exactly the bur's radius: what is seen
// cutting is what cuts. Sizes: shank 2.35 mm (ISO 1797 type 2), straight handpiece about 110 mm long.
// Any thread; some ms. Not the shape that is felt (a sphere of the same radius).
#pragma once

#include "assets/mesh.h"

namespace assets {

struct InstrumentParameters {
  double bur_radius_mm = 2.0;  ///< 0.25..5
  int flutes = 10;             ///< blades around the head, at least 8
};

/// Throws LoadError if a parameter is out of range.
MeshModel surgicalHandpiece(const InstrumentParameters& parameters);

}  // namespace assets
