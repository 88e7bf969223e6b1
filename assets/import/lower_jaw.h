// Centre of the lower jaw, for a scan without a site.
// With labels: centroid of the numbered lower teeth, or the middle of the mandibular canal's line. From grey values:
// the lower jaw is the lowest and foremost bone of the face, an arch without palate. Its slices begin at most 16 mm
// above the first slice whose front lies within 25 mm of the foremost, and for 26 mm without a break have bone on both
// sides 18 mm from the middle and none in the middle 22 to 40 mm behind the front; the result is the centroid of solid
// in their front 20 mm. For tilts below 20 degrees and both sides of the jaw; a heuristic. Frame P (LPS mm). Any
// thread; 5 ns a voxel.
#pragma once

#include <optional>

#include "assets/ct_volume.h"

namespace assets {

/// None if no lower jaw is found.
std::optional<glm::dvec3> lowerJawCentre_P_mm(const CtVolume& ct, const std::vector<glm::dvec3>& mandibular_canal_P_mm);

}  // namespace assets
