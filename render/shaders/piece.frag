#version 450
// A piece of tooth that has left its place in the jaw: shaded as the ray-cast surface, with the tissue that the scan has
// at its first place.
#include "part_block.glsl"
#include "tissue_appearance.glsl"
#include "occlusion.glsl"
#include "tool_shade.glsl"

layout(location = 0) in vec3 p_P;
layout(location = 1) in vec3 normal_P;
layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  vec3 way = p_P - eye.eye_P.xyz;
  distance_mm = length(way);
  vec3 normal = normalize(normal_P);
  if (!gl_FrontFacing) normal = -normal;

  mat3 Q_from_P = transpose(mat3(part.P_from_mesh));
  vec3 p_Q = Q_from_P * (p_P - part.P_from_mesh[3].xyz);
  Visibility open = visibilityFromVolume(p_P, normal);
  float enamel;
  Surface surface = tissueAt(indexFromPoint(p_Q), Q_from_P * normal, p_Q, p_P, normal, open.ambient, enamel);
  Visibility visibility = besideTool(litHollow(open), p_P, normal);
  vec3 light = throughSpray(lit(surface, p_P, normal, -way / distance_mm, visibility), p_P);
  colour = vec4(underRing(light, p_P), 1.0);
}
