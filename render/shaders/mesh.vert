#version 450
// A vertex of a mesh part, transformed to P.
#include "eye_block.glsl"
#include "part_block.glsl"

layout(location = POSITION_ATTRIBUTE) in vec3 position;
layout(location = NORMAL_ATTRIBUTE) in vec3 normal;
layout(location = COLOUR_ATTRIBUTE) in vec4 tint;
layout(location = 0) out vec3 p_P;
layout(location = 1) out vec3 normal_P;
layout(location = 2) out vec4 vertex_tint;

void main() {
  vec4 p = part.P_from_mesh * vec4(position, 1.0);
  p_P = p.xyz;
  normal_P = mat3(part.P_from_mesh) * normal;
  vertex_tint = tint;
  gl_Position = eye.clip_from_P * p;
}
