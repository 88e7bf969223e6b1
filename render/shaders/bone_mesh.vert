#version 450
// A vertex of the bone's triangles, already in P.
#include "eye_block.glsl"

layout(location = POSITION_ATTRIBUTE) in vec3 position_P;
layout(location = 0) out vec3 p_P;
invariant gl_Position;

void main() {
  p_P = position_P;
  gl_Position = eye.clip_from_P * vec4(position_P, 1.0);
}
