// How incision and flap are drawn: the closed gum with the place of the sheet cut out along its very border, and a wall
// where the cut goes through the gum; the sheet as thick as the gum, with a rounded wet edge and a raw underside; the
// incision as a fine dark red line. Frame P, mm. Pure; any thread; some ms for the gum, about one for the sheet.
#pragma once

#include "app/procedure/flap/flap.h"
#include "assets/mesh.h"

namespace app {

/// `gum_P`: closed.
assets::MeshModel gumAround(const assets::MeshModel& gum_P, const GumChart& chart, const FlapSheet& sheet);

/// Sheet, where there is one, and incision; no part before the first cut.
assets::MeshModel flapMesh(const Flap& flap);

}  // namespace app
