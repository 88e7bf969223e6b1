// Where the labelled third molar lies: centroid of its enamel and dentine, the direction root to crown, and its side.
// Direction: the tooth's long axis (first principal axis of enamel, dentine and pulp), towards its enamel; where the
// tooth has no clear long axis (a germ without roots), from the middle of the tooth to the middle of its enamel. Side:
// the patient's right is -x in LPS, but a cropped scan's origin says nothing about the midline; the front teeth do: a
// right molar lies to the right of the most anterior teeth, or of the most anterior bone. Frame P, mm. Any thread; a
// pass over the labels, about 2 ns a voxel.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/patient.h"
#include "assets/volume_grid.h"

namespace assets {

/// `known` is false if fewer than 10 mm3 of enamel and dentine are labelled.
OperatingSite thirdMolarSite(const VolumeGrid& grid, const std::vector<std::uint8_t>& label);

}  // namespace assets
