#version 450
// In an image of 2x2 samples per pixel: nearest depth and distance wherever the pixel is no edge, so that nothing is
// drawn there and no ray is cast.
#include "shared_constants.glsl"

layout(binding = EDGE_MASK_UNIT) uniform usampler2D edge_mask;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  if (texelFetch(edge_mask, ivec2(gl_FragCoord.xy) / EDGE_SAMPLES, 0).r != 0u) discard;
  distance_mm = 1e-6;
  gl_FragDepth = 1.0;
}
