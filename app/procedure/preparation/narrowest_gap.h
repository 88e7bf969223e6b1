// Where a gap between two biting surfaces is narrowest, between the places of its raster: a cusp's top lies beside
// them, and the highest of several places is their last digit's. A round form is fitted around the narrowest place;
// where the surfaces are not round there (an edge, a step) it is that place itself. mm. Pure; any thread; microseconds
// after the search.
#pragma once

#include "app/procedure/preparation/occlusal_heights.h"

namespace app {

struct NarrowestGap {
  glm::dvec2 place_mm{0.0};
  double gap_mm = std::numeric_limits<double>::infinity();  ///< infinite: there is no gap at all
};

NarrowestGap narrowestGap(const OcclusalRaster& gap_mm);

}  // namespace app
