// The straight surgical handpiece with a carbide bur - round, round-ended, fissure or tapered -, as it is drawn in
// frame T: origin at the centre of the cutting head, +z along the shaft away from the tip, mm. Parts "Bur" (turns about
// z) and "Handpiece" (stands still). The blades reach exactly the bur's radius: what is seen cutting is what cuts.
// Sizes: shank 2.35 mm (ISO 1797 type 2), straight handpiece about 110 mm long. Any thread; some ms. Not the shape that
// is felt (haptics/tool), whose outline the blades' edges follow.
#pragma once

#include "assets/mesh.h"

namespace assets {

/// Outlines about z, all with their middle at the origin: a sphere, a rod with round ends, a rod with flat ends, a cone
/// with its tip at -z.
enum class BurForm { round, capsule, cylinder, cone };

struct HandpieceParameters {
  double bur_radius_mm = 2.0;  ///< 0.25..5, the largest
  int flutes = 10;             ///< blades around the head, at least 8
  BurForm form = BurForm::round;
  double bur_length_mm = 0.0;   ///< 0..20: of the capsule's straight part, the cylinder, the cone
  double neck_radius_mm = 0.0;  ///< behind the head, at most the head's; 0: as fits it
};

/// Throws LoadError if a parameter is out of range.
MeshModel surgicalHandpiece(const HandpieceParameters& parameters);

}  // namespace assets
