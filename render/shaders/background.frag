#version 450
// The dark operating theatre: a neutral gradient fixed to the room, not to the screen.
#include "eye_block.glsl"
#include "light_constants.glsl"

layout(location = 0) in vec2 uv;
layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  vec3 direction = rayDirection(uv);
  float height = dot(direction, eye.up_P.xyz);
  float facing = 1.0 - smoothstep(0.0, BACKGROUND_GLOW_REACH, length(uv - 0.5));
  vec3 wall = mix(vec3(BACKGROUND_FLOOR), vec3(BACKGROUND_SKY), smoothstep(-0.5, 0.5, height));
  colour = vec4(wall + BACKGROUND_GLOW * facing * vec3(BACKGROUND_GLOW_TINT), 1.0);
  distance_mm = 0.0;
}
