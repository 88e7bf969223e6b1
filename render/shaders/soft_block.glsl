// Uniforms of the marks on soft tissue. Frame P, mm; C++ twin: render::SoftBlock.
#include "shared_constants.glsl"

layout(std140, binding = SOFT_BLOCK) uniform SoftBlock {
  ivec4 counts;                     // cuts, reddened places
  vec4 bound_P;                     // ball around all cuts and their rims; w: radius
  vec4 cut_from_P[SOFT_CUTS];       // w: radius
  vec4 cut_way_P[SOFT_CUTS];        // to its other end; w: 1 / squared length
  vec4 reddened_P[SOFT_REDDENED];   // w: 1 / (ln 2 · reach²)
  vec4 share[SOFT_REDDENED];        // x
} soft;
