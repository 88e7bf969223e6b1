// The crown of the tooth to be removed, and the way in to it: the direction from which a bur works beside, over and
// through it. Frame P, mm. Any thread; a pass over the volume, some 10 ms.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/case/height_map.h"
#include "assets/ct_volume.h"
#include "assets/operative_site.h"

namespace app {

/// Voxel `v` is of tooth `fdi`; where no tooth is numbered, of any.
bool isOfTooth(const assets::CtVolume& ct, std::size_t v, int fdi);

struct OperatedCrown {
  std::vector<glm::dvec3> voxels_P_mm;  ///< above the cervical line; not empty
  glm::dvec3 middle_P_mm{0.0};
  double cervix_mm = 0.0;  ///< along the tooth's axis, from the origin of P
};

/// None: the tooth has no voxel.
std::optional<OperatedCrown> operatedCrown(const assets::CtVolume& ct, const assets::OperativeSite& site);

/// Unit, horizontal but for `up`, square to each other.
struct SiteAxes {
  glm::dvec3 distal_P, buccal_P, up_P;

  /// Out of the bone along up + to_cheek * buccal - to_front * distal, with its rows along the arch.
  WayIn wayIn(const glm::dvec3& middle_P_mm, double to_cheek, double to_front) const;
};
SiteAxes siteAxes(const assets::CtVolume& ct, const assets::OperativeSite& site);

/// Up, to the cheek and to the front: between the surgeon's line of sight and the tooth. The farther the crown leans,
/// the more to the front: a more upright shaft would stand in bone, behind a mesio-angular crown or before a
/// disto-angular one. Beside an upright crown a way from far in front would not reach the distal side.
WayIn wayIn(const assets::CtVolume& ct, const assets::OperativeSite& site, const glm::dvec3& middle_P_mm);

}  // namespace app
