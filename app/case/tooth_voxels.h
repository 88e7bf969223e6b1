// The voxels of one numbered tooth as points, for measuring it: all of them, those of enamel, and the middles of the
// voxel faces of its surface. Frame P, mm. Immutable; any thread; a pass over the volume, some 10 ms.
#pragma once

#include <vector>

#include "assets/ct_volume.h"

namespace app {

/// A face of the tooth's surface; the direction points out of the tooth.
struct ToothFace {
  glm::dvec3 middle_P_mm;
  glm::ivec3 outward;
};

struct ToothVoxels {
  std::vector<glm::dvec3> all_P_mm, enamel_P_mm;
  std::vector<ToothFace> faces;
};

/// The box of a tooth and its voxels alone, those that belong to no part of it as enamel or dentine by their grey
/// value. No voxels: the tooth is not in the volume.
assets::CtVolume toothAlone(const assets::CtVolume& ct, int fdi);

/// Empty where no voxel has this number.
ToothVoxels toothVoxels(const assets::CtVolume& ct, int fdi);

/// The cervical line: around the axis, sector by sector, the enamel that lies lowest. Empty without enamel on at least
/// three quarters of the sectors.
std::vector<glm::dvec3> cervicalLine_P_mm(const ToothVoxels& tooth, const glm::dvec3& axis_P);

}  // namespace app
