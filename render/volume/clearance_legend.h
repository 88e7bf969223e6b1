// The legend of the clearance bands: each band's pattern and colour as on the bone, with its distance to the canal in
// mm. An upright picture for a corner of the eye's image, on every back-end the same. Any thread; pure.
#pragma once

#include <glm/glm.hpp>

#include "render/image.h"

namespace render {

/// Size of a picture whose lines are `line_px` high.
glm::ivec2 clearanceLegendSize(int line_px);
Image clearanceLegend(int line_px);

}  // namespace render
