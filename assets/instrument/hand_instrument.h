// Hand instruments as drawn, in frame T: +z along the shaft away from the tip, which lies at z = -r below the origin
// (r: haptics/tool/hand_instrument). Scalpel: blade thin in x, its edge towards -y. Periosteal elevator, curette and
// file: broad in x; the hollow of the spoon, the teeth of the file towards -y. What fills a tooth is round; of the
// carver the edge is towards -y. mm. Parts "Blade" (or tip), "Shank" and "Handle", each closed, some 2,000 triangles.
// Shapes after usual patterns (unverified). Any thread; under 1 ms. Drawn only: it does nothing to tissue.
#pragma once

#include "assets/mesh.h"

namespace assets {

enum class HandInstrumentForm {
  scalpel_15,
  periosteal,
  curette,
  bone_file,
  suction,
  composite,  ///< applicators, with some of their material at the tip
  glass_ionomer,
  amalgam,
  wax,
  gutta_percha,
  plugger,
  carver,
  curing_lamp,
  root_plugger,
};

MeshModel handInstrument(HandInstrumentForm form);

}  // namespace assets
