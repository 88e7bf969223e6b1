#version 450
// Blends the transparent fragments of a pixel, nearest first, into one premultiplied colour. Guides count where they lie
// behind what is seen; of the faded face only the nearest fragment.
#include "fragment_list.glsl"
#include "light_constants.glsl"

layout(binding = SCENE_DISTANCE_UNIT) uniform sampler2D scene_distance;
layout(location = COLOUR_TARGET) out vec4 colour;

const int kMaxFragments = 16;  // the nearest ones
// Longest list. Where a triangle covers part of a block of pixels, llvmpipe also runs the other pixels, reads zeros for
// them and would loop.
const int kLongest = 128;

// Strict order; two fragments of the same light at the same distance count once.
bool liesBefore(uvec3 a, uvec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

void main() {
  uint first = imageLoad(fragment_heads, ivec2(gl_FragCoord.xy)).r;
  if (first == kEnd) discard;
  colour = vec4(0.0);
  float seen_mm = texelFetch(scene_distance, ivec2(gl_FragCoord.xy), 0).r;

  // The nearest of the list, then the nearest behind it, and so on, without memory for sorting.
  uvec3 last = uvec3(0u);
  bool is_veiled = false;
  for (int n = 0; n < kMaxFragments; ++n) {
    uvec3 nearest = uvec3(kEnd);
    uint at = first;
    for (int i = 0; i < kLongest && at != kEnd; ++i, at = fragment_list.fragment[at].next) {
      // Positive floats are ordered as their bits.
      uvec3 here = uvec3(floatBitsToUint(fragment_list.fragment[at].distance_mm), fragment_list.fragment[at].light);
      if (liesBefore(last, here) && liesBefore(here, nearest)) nearest = here;
    }
    if (nearest.x == kEnd) break;
    vec2 red_green = unpackHalf2x16(nearest.y), blue_opacity = unpackHalf2x16(nearest.z & ~kVeilBit);
    last = nearest;
    if ((nearest.z & kVeilBit) != 0u) {
      if (is_veiled) continue;
      is_veiled = true;
    }
    bool is_open = seen_mm == 0.0 || uintBitsToFloat(nearest.x) < seen_mm + GUIDE_HIDDEN_MM;
    if (blue_opacity.y < 0.0 && is_open) continue;
    colour += (1.0 - colour.a) * abs(blue_opacity.y) * vec4(red_green, blue_opacity.x, 1.0);
  }
}
