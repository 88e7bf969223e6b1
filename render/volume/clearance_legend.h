// The legend of the clearance bands: each band's pattern and colour as on the bone, with its distance to the canal in
// mm. An upright picture for a corner of the eye's image, on every back-end the same. Any thread; pure.
#pragma once

#include <glm/glm.hpp>

#include "render/image.h"

namespace render {

/// Size of a picture with letters of `dot_px` pixels a dot.
glm::ivec2 clearanceLegendSize(int dot_px);
Image clearanceLegend(int dot_px);

}  // namespace render
