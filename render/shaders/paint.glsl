// What is painted on the surface (C++: surface_paint.h): linear colour, premultiplied by its cover, of a box of voxels.
#include "volume_block.glsl"

vec3 painted(vec3 albedo, vec3 index) {
  if (volume.paint_size.w == 0) return albedo;
  vec3 texel = index - vec3(volume.paint_low.xyz);
  vec4 paint = textureLod(paint_field, (texel + 0.5) / vec3(volume.paint_size.xyz), 0.0);
  return albedo * (1.0 - paint.a) + paint.rgb;
}
