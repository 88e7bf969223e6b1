// The legend of what is painted on the surface (surface_paint.h): a row of colour and words for each of its meanings.
// An upright picture for a corner of the eye's image, on every back-end the same. Any thread; pure; a millisecond.
#pragma once

#include <glm/glm.hpp>

#include "render/image.h"
#include "render/volume/surface_paint.h"

namespace render {

/// Size of a picture whose lines are `line_px` high.
glm::ivec2 paintLegendSize(const SurfacePaint& paint, int line_px);
Image paintLegend(const SurfacePaint& paint, int line_px);

}  // namespace render
