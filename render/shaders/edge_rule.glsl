// Which pixels lie at an edge and are drawn again with 2x2 samples. A plane's inverse distance runs straight through the
// image, so what a surface's slope explains leaves no bend; a step does. Twin: render/cpu/edges.h.
#include "light_constants.glsl"

// Of a pixel and two neighbours on opposite sides, mm along their rays, 0 where nothing is met.
bool bends(float before, float here, float after) {
  float a = before > 0.0 ? 1.0 / before : 0.0, c = here > 0.0 ? 1.0 / here : 0.0, b = after > 0.0 ? 1.0 / after : 0.0;
  return abs(a - 2.0 * c + b) > EDGE_BEND * max(max(a, b), max(c, 1e-9));
}
