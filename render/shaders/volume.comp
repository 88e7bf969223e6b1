#version 450
// Tooth and bone, one ray per invocation, into the volume layer. Twin: volume.frag.
#include "volume_pixel.glsl"

layout(local_size_x = CAST_GROUP, local_size_y = CAST_GROUP) in;
layout(binding = COLOUR_TARGET, rgba16f) uniform writeonly restrict image2D light_image;
layout(binding = DISTANCE_TARGET, r32f) uniform writeonly restrict image2D distance_image;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(light_image)))) return;
  VolumePixel seen = volumeAt(pixel);
  imageStore(light_image, pixel, seen.light);
  imageStore(distance_image, pixel, vec4(seen.distance_mm));
}
