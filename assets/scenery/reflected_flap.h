// The mucoperiosteal flap as it is held open: a relieving incision in front of the wound, and the flap folded over the
// cheek's side of the wound's edge, as thick as gingiva, its raw underside up. It works on a narrow-band level set of
// the gingiva before the wound is cut, in voxels. Envelope flap with a relieving incision (Koerner 2006); how far it
// folds is our own choice: it stays under the cheek retractor. The flap keeps out of the wound, so it never stands
// between the cut and the eye. Frame P, mm. Any thread; about 0.3 s.
#pragma once

#include <openvdb/openvdb.h>

#include "assets/planned_cut.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/volume_grid.h"

namespace assets {

class ReflectedFlap {
 public:
  static constexpr double kFolded_mm = 4.2;  ///< from the fold to the free edge

  /// `gingiva`: before the wound is cut. `wound` is borrowed and must outlive this object.
  ReflectedFlap(const openvdb::FloatGrid& gingiva, const VolumeGrid& voxels, const PlannedCut& cut, const Wound& wound);

  /// Cuts the relieving incision and adds the folded flap.
  void addTo(openvdb::FloatGrid& grid) const;

  /// Distance to the folded flap, negative inside it; large where there is none.
  double distance_mm(const glm::dvec3& p_P_mm) const;
  /// Distance to the relieving incision, negative inside it.
  double incision_mm(const glm::dvec3& p_P_mm) const;

 private:
  double towardsCheek(const glm::dvec3& p_P_mm) const;

  const Wound& wound_;
  VolumeGrid voxels_;
  openvdb::FloatGrid::Ptr surface_;  ///< widened around the wound, voxels
  glm::dvec3 middle_P_mm_, buccal_P_, mesial_P_;
  glm::dvec3 corner_P_mm_, along_P_, across_P_;  ///< of the incision; across: forwards
  glm::dvec3 low_P_mm_, high_P_mm_;              ///< box around flap and incision
};

}  // namespace assets
