// The surfaces of teeth where the grey value changes most: a watershed of its gradient between the regions without
// their outermost voxels and what lies more than 0.8 mm outside (of the thin ends of roots, which have no voxels but
// outermost ones: those, and 1.2 mm). A threshold is biased at crowns (the level half-way to air is lower there). Each
// tooth in a box of its own with what lies around it; where two claim a voxel it is the first one's. Any thread but the
// servo; parallel over teeth; 2 s of CPU for a whole jaw at 0.35 mm, 0.1 s for a tooth that is not known.
#pragma once

#include "assets/segment/known_parts.h"
#include "assets/segment/tooth_regions.h"

namespace assets {

class ToothSurfaces {
 public:
  /// Of one jaw. The box may grow. The same whatever was asked before.
  ToothRegions placed(const Mandible& jaw, const ToothRegions& teeth);

 private:
  KnownParts<CellMask> known_;  ///< by the regions in its box: which cells are the tooth's
};

}  // namespace assets
