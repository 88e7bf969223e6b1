#version 450
// A patch of the overlay over a composed output, pixel by pixel: sRGB, premultiplied, blended as it is.
#include "shared_constants.glsl"

layout(binding = INSET_UNIT) uniform sampler2D patch_image;  // top row first
layout(location = 0) in vec2 uv;
layout(location = COLOUR_TARGET) out vec4 colour;

void main() {
  ivec2 size = textureSize(patch_image, 0);
  colour = texelFetch(patch_image, clamp(ivec2(vec2(uv.x, 1.0 - uv.y) * vec2(size)), ivec2(0), size - 1), 0);
}
