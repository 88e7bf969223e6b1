// Removes a scan's face: everything farther from bone and teeth than a distance becomes air, so that no skin of cheek,
// nose or chin is left to recognise a person by (DICOM PS3.15 counts a face as a recognisable visual feature). Bone is
// what is dense in cells of 1 mm and hangs together in more than 0.5 cm3, so that noise and ear-rings keep no skin. The
// distance is kept conservatively: what stays is surely within it. Parallel (TBB); 2 ns a voxel. Any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

inline constexpr double kKeptSoftTissue_mm = 12.0;

/// Volume of what was denser than -300 HU and became air, mm3. `bone_hu`: lower limit of bone.
double removeDistantSoftTissue(const VolumeGrid& grid, std::vector<std::int16_t>& hounsfield, double bone_hu,
                               double distance_mm = kKeptSoftTissue_mm);

}  // namespace assets
