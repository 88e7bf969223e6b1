#version 450
// Opaque parts of meshes.
#include "mesh_colour.glsl"
#include "glass.glsl"

layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  bool reflects = int(part.finish.z) == FINISH_GLASS && eye.glass.x > 0.0 && gl_FrontFacing;
  colour = reflects ? vec4(inGlass(ivec2(gl_FragCoord.xy)), GLASS_ALPHA) : meshColour();
  distance_mm = distance(p_P, eye.eye_P.xyz);
}
