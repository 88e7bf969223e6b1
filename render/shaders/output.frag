#version 450
// The last pass: averages the samples of each pixel in linear light, combines the eyes, and encodes sRGB, once.
#include "shared_numbers.glsl"
#include "light_numbers.glsl"

layout(std140, binding = OUTPUT_BLOCK) uniform OutputBlock {
  ivec4 mode;            // x: OUTPUT_…, y: samples along each edge of a pixel
  ivec4 corner;          // x, y: lower left of the picture in the target, px
} job;

layout(binding = LEFT_EYE_UNIT) uniform sampler2D left_eye;
layout(binding = RIGHT_EYE_UNIT) uniform sampler2D right_eye;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 colour;

// Bright values roll off towards white instead of clipping: identity to 0.7, then an even approach to 1.
vec3 shoulder(vec3 x) {
  const float knee = SHOULDER_KNEE;
  vec3 over = max(x - knee, 0.0) / (1.0 - knee);
  return min(x, knee) + (1.0 - knee) * (over / (1.0 + over));
}

vec3 resolved(sampler2D picture, ivec2 pixel) {
  vec3 sum = vec3(0.0);
  for (int j = 0; j < job.mode.y; ++j)
    for (int i = 0; i < job.mode.y; ++i)
      sum += shoulder(texelFetch(picture, pixel * job.mode.y + ivec2(i, j), 0).rgb);
  return sum / float(job.mode.y * job.mode.y);
}

// IEC 61966-2-1.
vec3 srgb(vec3 x) {
  return mix(12.92 * x, 1.055 * pow(max(x, 1e-6), vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - job.corner.xy;
  vec3 light = resolved(left_eye, pixel);
  if (job.mode.x == OUTPUT_ANAGLYPH) light.gb = resolved(right_eye, pixel).gb;
  colour = vec4(srgb(clamp(light, 0.0, 1.0)), 1.0);
}
