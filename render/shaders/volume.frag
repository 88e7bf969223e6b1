#version 450
// Tooth and bone, one ray per pixel, into the volume layer. Twin: volume.comp.
#include "volume_pixel.glsl"

layout(location = COLOUR_TARGET) out vec4 light;
layout(location = DISTANCE_TARGET) out float distance_mm;

void main() {
  VolumePixel seen = volumeAt(ivec2(gl_FragCoord.xy));
  light = seen.light;
  distance_mm = seen.distance_mm;
}
