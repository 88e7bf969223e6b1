// Gingiva as a surface with the mucoperiosteal flap raised: bone and tooth are bare on the buccal and occlusal side of
// the tooth at the site, within about 12 mm; the wound's edge is rounded and darker. Its underside lies a little inside
// the bone, so the surfaces do not coincide. Drawn only, never cut. Envelope flap with buccal reflection (Koerner
// 2006), extent our own choice. Frame P, mm. Any thread; about 1 s per 10^6 labelled voxels.
#pragma once

#include <optional>

#include "assets/ct_volume.h"
#include "assets/mesh.h"
#include "assets/patient.h"

namespace assets {

/// One part "Gum", or no part where nothing is labelled gingiva. The flap is raised only where there is a site.
/// Throws LoadError if labels and grid do not fit.
MeshModel gingivaSurface(const CtVolume& ct, const std::optional<OperativeSite>& site);

/// Signed distance to the wound, negative where gingiva is removed.
double flapDistance_mm(const OperativeSite& site, const glm::dvec3& p_P_mm);

}  // namespace assets
