#version 450
// 1 where antialiasing draws the pixel again with 2x2 samples. The inverse distance of a plane is linear in the image,
// so the second difference is zero for any slope and large at a step; at the image border it is taken as zero. Twin:
// render/cpu/edges.h.
#include "shared_constants.glsl"
#include "light_constants.glsl"

layout(binding = SCENE_DISTANCE_UNIT) uniform sampler2D scene_distance;
layout(binding = LAYER_LIGHT_UNIT) uniform sampler2D scene_light;
layout(binding = REFLECTED_DISTANCE_UNIT) uniform sampler2D reflected_distance;
layout(location = 0) out uint is_edge;

// In a mirror's glass: as far as the image lies behind it.
float distanceAt(ivec2 pixel) {
  bool is_glass = texelFetch(scene_light, pixel, 0).a > 0.75 * GLASS_ALPHA;
  return is_glass ? texelFetch(reflected_distance, pixel, 0).r : texelFetch(scene_distance, pixel, 0).r;
}

// For a pixel and two opposite neighbours, mm along their rays, 0 where nothing is hit.
bool bends(float before, float here, float after) {
  float a = before > 0.0 ? 1.0 / before : 0.0, c = here > 0.0 ? 1.0 / here : 0.0, b = after > 0.0 ? 1.0 / after : 0.0;
  return abs(a - 2.0 * c + b) > EDGE_BEND * max(max(a, b), max(c, 1e-9));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(scene_distance, 0) - 1;
  const ivec2 x = ivec2(1, 0), y = ivec2(0, 1);
  float here = distanceAt(pixel);
  bool wide = pixel.x > 0 && pixel.x < last.x, high = pixel.y > 0 && pixel.y < last.y;
  is_edge = uint((wide && bends(distanceAt(pixel - x), here, distanceAt(pixel + x))) ||
                 (high && bends(distanceAt(pixel - y), here, distanceAt(pixel + y))));
}
