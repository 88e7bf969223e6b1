#version 450
// 1 where antialiasing draws the pixel again. At the border of the image the missing neighbour counts as straight on.
#include "shared_constants.glsl"
#include "edge_rule.glsl"

layout(binding = SCENE_DISTANCE_UNIT) uniform sampler2D scene_distance;
layout(location = 0) out uint is_edge;

float distanceAt(ivec2 pixel) { return texelFetch(scene_distance, pixel, 0).r; }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(scene_distance, 0) - 1;
  const ivec2 x = ivec2(1, 0), y = ivec2(0, 1);
  float here = distanceAt(pixel);
  bool wide = pixel.x > 0 && pixel.x < last.x, high = pixel.y > 0 && pixel.y < last.y;
  is_edge = uint((wide && bends(distanceAt(pixel - x), here, distanceAt(pixel + x))) ||
                 (high && bends(distanceAt(pixel - y), here, distanceAt(pixel + y))));
}
