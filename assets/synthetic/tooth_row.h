// The lower teeth of one side in their places: premolars, first and second molar, and the impacted third molar.
// Frame J (dental_arch.h), mm. Immutable once built; any thread reads. Building costs about 1 s: a shape per tooth and
// the search for the third molar's contact. Occlusal plane z = 0: the highest cusp of every erupted tooth touches it.
#pragma once

#include <vector>

#include "assets/synthetic/dental_arch.h"
#include "assets/synthetic/tooth_shape.h"

namespace assets {

struct PlacedTooth {
  int position = 6;             ///< 4..8 from the midline
  const ToothShape& shape;      ///< one for all jaws, see lowerToothShape
  glm::dvec3 cervix_J_mm{0.0};  ///< origin of the tooth frame
  glm::dmat3 axes_J{1.0};       ///< columns: mesial, buccal, occlusal

  glm::dvec3 local(const glm::dvec3& p_J) const { return (p_J - cervix_J_mm) * axes_J; }
  glm::dvec3 inJaw(const glm::dvec3& p) const { return cervix_J_mm + axes_J * p; }
};

/// Arc length of the centre of each tooth, 1..7, and height of its crown: shared with the landmarks.
double arcLengthAtTooth_mm(int position);
double toothCrownHeight_mm(int position);

/// A premolar or one of the first two molars (4..7), upright on the arch with the natural lean to the tongue.
PlacedTooth eruptedTooth(const DentalArch& arch, int position);

/// Third molar turned by the Winter angle (positive: crown to mesial), its highest point `depth_mm` below the occlusal
/// plane, moved forward until it all but touches the second molar.
PlacedTooth impactedThirdMolar(const DentalArch& arch, const PlacedTooth& second_molar, double winter_angle_deg,
                               double depth_mm);

}  // namespace assets
