// Which tooth of a patient a ray meets first, and the voxels to mark it with. Frame P, mm. Pure; any thread; a ray
// costs some 10 µs, the voxels a pass over the volume.
#pragma once

#include <optional>
#include <vector>

#include "assets/ct_volume.h"

namespace app {

/// FDI number of the first solid on the way from `eye_P_mm` along `way_P`; none: no tooth with a number, bone included.
std::optional<int> pointedTooth(const assets::CtVolume& ct, const glm::dvec3& eye_P_mm, const glm::dvec3& way_P);

/// Every second voxel of a tooth along each axis.
std::vector<glm::vec3> markedVoxels_P_mm(const assets::CtVolume& ct, int fdi);

}  // namespace app
