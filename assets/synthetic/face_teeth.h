// The lower teeth of the built-in face (face.h), by which fitFace() places it on a scanned jaw: the row of teeth 8 to 8
// along the dental arch, each in the middle of crown and root. Frame F of the face with its mouth open. Adult means
// (dental_arch.h). Any thread; microseconds.
#pragma once

#include <vector>

#include "assets/mesh.h"
#include "assets/scenery/face_placement.h"

namespace assets {

/// Of syntheticFace(), on the axes of kFaceAxes_PF; the row is the same whichever side is operated.
std::vector<FaceTooth> builtInFaceTeeth();

/// Leaves out of the lower teeth of a face in P those whose place has a tooth of the scan's own within 6 mm.
/// `own_P_mm`: middles of the scan's lower teeth.
void dropTeeth(MeshModel& face_P, const FacePlacement& placed, const std::vector<FaceTooth>& teeth,
               const std::vector<glm::dvec3>& own_P_mm);

}  // namespace assets
