// The long axis of a labelled tooth, from root to crown, as its crown has it: the normal of the cervical line, where
// the enamel ends. Roots bend, spread or are cut off; the first principal axis of a stubby or bent molar follows them
// (16 degrees off on a real one). Sum of the unit normals over the faces between dentine and enamel = the vector area
// that the cervical line encloses (Stokes), whatever the cap between looks like, worn or fissured; voxel faces give it
// without a staircase's error. Where the volume's border cuts the enamel: the plane through what is left of the
// cervical line, 20 degrees off where half of it is gone, for it is wavy. Without enamel: the first principal axis,
// towards the other jaw. Frame P, unit. Any thread; 20 ns a voxel around the tooth.
#pragma once

#include "assets/ct_volume.h"

namespace assets {

/// The tooth must have voxels. Enamel of a tooth labelled as one (other_teeth) is told by its grey value.
glm::dvec3 toothAxis_P(const CtVolume& ct, int fdi);

}  // namespace assets
