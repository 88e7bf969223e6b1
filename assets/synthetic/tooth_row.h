// Lower teeth of one side in position: the front ones, premolars, first and second molar, the impacted third molar.
// Frame J (dental_arch.h), mm. Immutable once built; any thread. Building takes about 1 s. Occlusal plane z = 0: the
// highest cusp of every erupted tooth touches it.
#pragma once

#include <vector>

#include "assets/synthetic/dental_arch.h"
#include "assets/synthetic/tooth_shape.h"

namespace assets {

struct PlacedTooth {
  int position = 6;             ///< 1..8 from the midline
  const ToothShape& shape;      ///< lowerToothShape(position)
  glm::dvec3 cervix_J_mm{0.0};  ///< origin of the tooth frame
  glm::dmat3 axes_J{1.0};       ///< columns: mesial, buccal, occlusal

  glm::dvec3 local(const glm::dvec3& p_J) const { return (p_J - cervix_J_mm) * axes_J; }
  glm::dvec3 inJaw(const glm::dvec3& p) const { return cervix_J_mm + axes_J * p; }
};

/// An incisor, canine, premolar or one of the first two molars (1..7), upright on the arch with the natural lean to the
/// tongue.
PlacedTooth eruptedTooth(const DentalArch& arch, int position);

/// Third molar rotated by the Winter angle (positive: crown to mesial), its highest point `depth_mm` below the occlusal
/// plane, moved forward until it nearly touches the second molar.
PlacedTooth impactedThirdMolar(const DentalArch& arch, const PlacedTooth& second_molar, double winter_angle_deg,
                               double depth_mm);

}  // namespace assets
