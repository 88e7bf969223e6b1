// The patient's own face, out of a scan whose skin was kept: the outside of the head at -300 HU (the level by which
// faces are removed, assets/import/soft_tissue_removal.h), a shell 3 mm thick, open over the site along the line of
// sight as a cheek that is held aside. What the field of view cuts off is missing. Frame P, mm. Start-up only; about
// 3 s for a whole head on two cores.
#pragma once

#include <glm/glm.hpp>

#include "assets/ct_volume.h"
#include "assets/mesh.h"

namespace app {

/// One part, "Face"; none where less than 50 cm² of skin lies in the scan. `to_eye_P`: unit, from the site.
assets::MeshModel ownFace(const assets::CtVolume& ct, const glm::dvec3& site_P_mm, const glm::dvec3& to_eye_P);

}  // namespace app
