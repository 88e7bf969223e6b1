#version 450
// The dark theatre behind everything: a neutral gradient fixed to the room, not to the screen.
#include "eye_block.glsl"

layout(location = 0) in vec2 place;
layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  vec3 direction = rayDirection(place);
  float height = dot(direction, eye.up_P.xyz);
  float facing = 1.0 - smoothstep(0.0, 0.45, length(place - 0.5));
  vec3 wall = mix(vec3(0.010, 0.0115, 0.013), vec3(0.040, 0.044, 0.048), smoothstep(-0.5, 0.5, height));
  colour = vec4(wall + 0.022 * facing * vec3(0.9, 1.0, 1.08), 1.0);
  distance_mm = 0.0;
}
