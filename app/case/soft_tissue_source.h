// The soft tissue around a patient's site, computed once and kept in the user's cache under the fingerprint of the
// meshes. A file that is damaged or foreign is made again and never used; a cache that cannot be written costs the time
// again. Frame P. Start-up; about 30 ms from the cache, else as assets::softTissueField.
#pragma once

#include "assets/mesh.h"
#include "assets/scenery/soft_tissue_surface.h"
#include "assets/soft_tissue_field.h"

namespace app {

assets::SoftTissueField softTissueAround(const assets::MeshModel& gingiva_P, const assets::MeshModel& face_P,
                                         const assets::SoftTissueRegion& region);

}  // namespace app
