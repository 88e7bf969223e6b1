// A periapical radiograph as a picture: dense tissue light, as films are read, with its tooth, tube shift, mesial side
// and a scale. Drawn by `molar radiograph`. Pure; any thread; some milliseconds beyond assets/scan/periapical.h.
#pragma once

#include <span>

#include "assets/scan/periapical.h"
#include "render/image.h"

namespace app {

/// `bone_mm` of radiographOf(). Two output pixels per pixel of the film.
render::Image radiographPicture(const assets::PeriapicalView& view, std::span<const float> bone_mm, int fdi,
                                double shift_deg);

}  // namespace app
