// Long axis of a labelled tooth, root to crown: the normal of the cervical line, where the enamel ends. The first
// principal axis follows bent, spread or cut roots (16 degrees off on a real molar). The sum of unit normals over the
// faces between dentine and enamel is the vector area enclosed by the cervical line (Stokes), independent of wear and
// exact for voxel faces. Where the volume's border cuts the enamel: the plane through the rest of the cervical line, 20
// degrees off with half of it. Without enamel: the first principal axis, towards the other jaw. Frame P, unit. Any
// thread; 20 ns a voxel of the tooth's box.
#pragma once

#include "assets/ct_volume.h"

namespace assets {

/// The tooth must have voxels. Enamel labelled other_teeth is recognised by its grey value.
glm::dvec3 toothAxis_P(const CtVolume& ct, int fdi);

}  // namespace assets
