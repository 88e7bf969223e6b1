// How a straight handpiece lies while the planned cut is made: the direction from the bur to the handpiece that keeps
// shaft and handpiece clear of lips, cheek, tongue and gingiva, and the shaft of bone and teeth that stay, without
// standing in the surgeon's line of sight. The outline is laid at places all over the cut, at its edges and above them,
// where the bur goes from stroke to stroke, and the directions of the half space outside the bone are compared, first
// 4.5 degrees apart, then closer around the best. Frame P, mm. Start-up, any thread; about 0.1 s.
#pragma once

#include "assets/ct_volume.h"
#include "assets/planned_cut.h"
#include "assets/soft_tissue_field.h"
#include "haptics/tool/tool.h"

namespace app {

/// What a handpiece in that direction meets.
struct HandpieceRoom {
  double soft_mm = 0.0;        ///< least distance to soft tissue anywhere in the cut or over it; negative: in it
  double in_bone_share = 0.0;  ///< of the places in the cut at which the shaft is in bone or a tooth
};
HandpieceRoom handpieceRoom(const assets::PlannedCut& cut, const assets::CtVolume& ct,
                            const assets::SoftTissueField& soft, const haptics::Tool& tool,
                            const glm::dvec3& direction_P);

/// Unit. Of a cut without a direction out of the bone, or without a stroke: zero.
glm::dvec3 handpieceDirection_P(const assets::PlannedCut& cut, const assets::CtVolume& ct,
                                const assets::SoftTissueField& soft, const haptics::Tool& tool);

}  // namespace app
