// Which end of a tooth is the crown, by its enamel and its pulp, and a turn by whole quarters that brings it upright:
// voxels are moved, none is resampled. Any thread; two passes over the voxels.
#pragma once

#include "assets/ct_volume.h"

namespace assets {

struct CrownSide {
  int axis = 2, sign = 1;  ///< of the volume: where the crown points to
  bool is_plain = false;   ///< enamel lies clearly off the dentine, and the pulp does not contradict it
};

CrownSide crownSide(const CtVolume& tooth);

/// The crown to +z or -z, about the volume's middle; labels and solid fraction.
void turnUpright(CtVolume& tooth, const CrownSide& crown, int up);

}  // namespace assets
