#version 450
// A small image over the scene: linear light that the output pass encodes back to the same values.
#include "shared_constants.glsl"
#include "shoulder.glsl"

layout(binding = INSET_UNIT) uniform sampler2D inset;   // top row first
layout(location = 0) in vec2 uv;
layout(location = COLOUR_TARGET) out vec4 colour;

// IEC 61966-2-1.
vec3 lightOf(vec3 srgb) {
  return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

void main() {
  ivec2 size = textureSize(inset, 0);
  ivec2 texel = clamp(ivec2(vec2(uv.x, 1.0 - uv.y) * vec2(size)), ivec2(0), size - 1);
  colour = vec4(inverseShoulder(lightOf(texelFetch(inset, texel, 0).rgb)), 1.0);
}
