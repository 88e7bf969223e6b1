#version 450
// Blends the volume layer over what is behind it.
#include "shared_constants.glsl"

layout(binding = LAYER_LIGHT_UNIT) uniform sampler2D layer_light;
layout(location = COLOUR_TARGET) out vec4 colour;

void main() {
  colour = texelFetch(layer_light, ivec2(gl_FragCoord.xy), 0);
  if (colour.a == 0.0) discard;
}
