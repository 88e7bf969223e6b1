#version 450
// Tooth and bone as triangles, shaded as the ray-cast surface at the same points.
#include "bone_light.glsl"

layout(location = 0) in vec3 p_P;
layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  vec3 way = p_P - eye.eye_P.xyz;
  distance_mm = length(way);
  colour = vec4(boneLight(indexFromPoint(p_P), p_P, way / distance_mm), 1.0);
}
