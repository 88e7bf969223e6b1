#version 450
// Writes the mean of the samples to edge pixels: averaged after the shoulder, as displayed, then mapped back.
#include "shared_constants.glsl"
#include "shoulder.glsl"

layout(binding = EDGE_MASK_UNIT) uniform usampler2D edge_mask;
layout(binding = LAYER_LIGHT_UNIT) uniform sampler2D samples;
layout(location = COLOUR_TARGET) out vec4 colour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (texelFetch(edge_mask, pixel, 0).r == 0u) discard;
  vec3 sum = vec3(0.0);
  for (int j = 0; j < EDGE_SAMPLES; ++j)
    for (int i = 0; i < EDGE_SAMPLES; ++i)
      sum += shoulder(texelFetch(samples, pixel * EDGE_SAMPLES + ivec2(i, j), 0).rgb);
  colour = vec4(inverseShoulder(sum / float(EDGE_SAMPLES * EDGE_SAMPLES)), 1.0);
}
