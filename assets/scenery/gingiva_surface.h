// The gingiva as a surface, with the mucoperiosteal flap raised: bone and tooth lie bare on the cheek and chewing side
// of the tooth at the site, within about 12 mm of it; the wound's edge is rounded and darker. Frame P, mm. Any thread;
// about 1 s per 10^6 labelled voxels. Drawn context: the bur does not cut it, and it hides nothing within the flap. Its
// underside lies a little inside the bone, so that the two surfaces never fight. Flap: envelope flap with buccal
// reflection (Koerner 2006); extent is our own choice.
#pragma once

#include <optional>

#include "assets/ct_volume.h"
#include "assets/mesh.h"
#include "assets/patient.h"

namespace assets {

/// One part "Gum", or no part where nothing is labelled gingiva. The flap is raised only where there is a site.
/// Throws LoadError if labels and grid do not fit.
MeshModel gingivaSurface(const CtVolume& ct, const std::optional<OperativeSite>& site);

/// Signed distance to the raised flap's wound, negative where gingiva is taken away: what a test or a tool may ask.
double flapDistance_mm(const OperativeSite& site, const glm::dvec3& p_P_mm);

}  // namespace assets
