// Dental mirror No. 5. Own frame: origin at the centre of the glass on its surface; +z along the handle away from the
// mirror, which faces +z and -y at 45 degrees to the handle; x across. mm. Parts "Glass", "Casing", "Stem", "Handle",
// each closed. Casing 24 mm (No. 4: 22 mm, 2 mm per size: ISO 9873, 4.1.4), stem of a two-piece mirror with M2.5
// thread, length 165 mm (at most 173 mm: ISO 9873, 4.1.1). Handle 7 mm, rim and stem by appearance. Any thread; some
// ms. What the glass reflects is the renderer's (render::MirrorGlass).
#pragma once

#include <glm/glm.hpp>

#include "assets/mesh.h"

namespace assets {

inline constexpr double kMirrorCasingRadius_mm = 12.0, kMirrorGlassRadius_mm = 11.0;

/// Unit, out of the glass.
glm::dvec3 mirrorGlassNormal();

MeshModel dentalMirror();

}  // namespace assets
