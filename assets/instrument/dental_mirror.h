// A dental mirror No. 5 as it is drawn, in its own frame: origin at the centre of the glass, on its surface; +z along
// the handle away from the mirror, which looks to +z and -y, half a right angle to the handle; x across. mm.
// Parts "Glass", "Casing", "Stem", "Handle", each a closed surface. Sizes: 24 mm over the casing (No. 4: 22 mm, each
// size 2 mm more: ISO 9873, 4.1.4), stem of a two-piece mirror with M2.5 thread, 165 mm long in all (at most 173 mm for
// a sterilisation cassette: ISO 9873, 4.1.1). Handle 7 mm thick, rim and stem as usual ones look: no standard says.
// Any thread; some ms. The glass shines as polished metal; the scene is not mirrored in it.
#pragma once

#include "assets/mesh.h"

namespace assets {

inline constexpr double kMirrorCasingRadius_mm = 12.0;

MeshModel dentalMirror();

}  // namespace assets
