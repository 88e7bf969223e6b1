// Combines the images of both eyes for a display: each pixel from the eye given by the layout, mixed in linear light
// for anaglyphs. Any thread; about 3 ms for 1080p, 15 ms where eyes alternate by columns, 60 ms for a colourful
// anaglyph.
#pragma once

#include "render/display/stereo_layout.h"
#include "render/image.h"

namespace app {

/// `left`, `right`: eyeImageSize() of the layout; mono shows `left`.
render::Image stereoPicture(const render::Image& left, const render::Image& right, const render::StereoLayout& layout);

}  // namespace app
