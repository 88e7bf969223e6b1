#version 450
// Transparent parts of meshes, into the list of their pixel. Fragments that do not fit are dropped.
#include "fragment_list.glsl"
#include "mesh_colour.glsl"

layout(early_fragment_tests) in;

void main() {
  vec4 colour = meshColour();
  if (gl_HelperInvocation) return;
  // A guide also lies in the scene as an opaque mesh: its overlay is for where that is hidden.
  if (int(part.finish.z) == FINISH_GUIDE) colour.a = -colour.a;
  uvec2 light = uvec2(packHalf2x16(colour.rg), packHalf2x16(colour.ba));
  if ((int(part.finish.w) & PART_VEIL) != 0) light.y |= kVeilBit;
  uint at = atomicAdd(fragment_list.count, 1u);
  if (at >= fragment_list.capacity) return;
  uint next = imageAtomicExchange(fragment_heads, ivec2(gl_FragCoord.xy), at);
  fragment_list.fragment[at] = Fragment(light, distance(p_P, eye.eye_P.xyz), next);
}
