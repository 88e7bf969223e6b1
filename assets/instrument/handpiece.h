// Straight surgical handpiece with a carbide bur (round, capsule, cylinder, cone or revolved), drawn in frame T: origin
// at the centre of the cutting head, +z along the shaft away from the tip, mm. Parts "Bur" (rotates about z) and
// "Handpiece" (fixed). The blades reach exactly the bur's radius, so the drawn bur matches the cutting one. Shank 2.35
// mm (ISO 1797 type 2), handpiece about 110 mm long. Any thread; some ms. The felt shape is haptics/tool.
#pragma once

#include "assets/bur_outline.h"
#include "assets/mesh.h"

namespace assets {

/// Centred at the origin, about z; the cone's tip points to -z.
enum class BurForm { round, capsule, cylinder, cone, revolved };

struct HandpieceParameters {
  double bur_radius_mm = 2.0;  ///< 0.25..5, maximum
  int flutes = 10;             ///< blades, 8..40
  BurForm form = BurForm::round;
  double bur_length_mm = 0.0;  ///< 0..20, of the capsule's straight part, the cylinder, the cone or the whole head
  BurProfile profile = BurProfile::wheel;  ///< of a revolved head
  double neck_radius_mm = 0.0;             ///< behind the head, at most its radius; 0: default
  bool handpiece = true;                   ///< false: the bur with its shank alone
};

/// Throws LoadError if a parameter is out of range.
MeshModel surgicalHandpiece(const HandpieceParameters& parameters);

}  // namespace assets
