#version 450
// Opaque parts of meshes.
#include "mesh_colour.glsl"

layout(location = COLOUR_TARGET) out vec4 colour;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  colour = meshColour();
  distance_mm = distance(p_P, eye.eye_P.xyz);
}
