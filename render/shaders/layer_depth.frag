#version 450
// Depth and distance of the volume layer where it is solid, the same as for triangles.
#include "eye_block.glsl"

layout(binding = LAYER_DISTANCE_UNIT) uniform sampler2D layer_distance;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  distance_mm = texelFetch(layer_distance, pixel, 0).r;
  if (distance_mm == 0.0) discard;
  vec3 direction = rayDirection((vec2(pixel) + 0.5) / vec2(textureSize(layer_distance, 0)));
  gl_FragDepth = depthOf(eye.eye_P.xyz + distance_mm * direction);
}
