// Where to look in a scan without a site: at the lower jaw, if it shows one.
// Labelled: the middle of the lower teeth that are told apart, or of the mandibular canal's line. In grey values alone
// the lower jaw is the lowest and foremost bone of the face, an arch with nothing in it: from at most 16 mm above the
// first slice whose front lies within 25 mm of the foremost, bone on both sides 18 mm from the middle and none in the
// middle behind the chin (22 to 40 mm from the front), for 26 mm without a break; an upper jaw has its palate there.
// Then the middle of the solid in the front 20 mm of these slices. Tilted less than 20 degrees. A heuristic,
// no segmentation: a one-sided piece of a jaw has no arch. Frame P (LPS mm). Any thread; 5 ns a voxel.
#pragma once

#include <optional>

#include "assets/ct_volume.h"

namespace assets {

/// None where no lower jaw is found.
std::optional<glm::dvec3> lowerJawCentre_P_mm(const CtVolume& ct, const std::vector<glm::dvec3>& mandibular_canal_P_mm);

}  // namespace assets
