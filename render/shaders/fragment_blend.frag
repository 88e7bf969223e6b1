#version 450
// The transparent places before a pixel, nearest first, as one premultiplied colour to lay over it.
#include "fragment_list.glsl"

layout(location = COLOUR_TARGET) out vec4 colour;

const int kMost = 16;  // the nearest that count
// Of a list. Where a triangle covers part of a block of pixels, llvmpipe runs the others too, reads zeros for them and
// would follow them in a circle until it gives up, for all pixels of the block.
const int kLongest = 128;

// A strict order of places; two of the same light at the same distance count once.
bool liesBefore(uvec3 a, uvec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

void main() {
  uint first = imageLoad(fragment_heads, ivec2(gl_FragCoord.xy)).r;
  if (first == kEnd) discard;
  colour = vec4(0.0);

  // The nearest of the list, then the nearest behind it, and so on: short lists need no memory to be sorted in.
  uvec3 last = uvec3(0u);
  for (int n = 0; n < kMost; ++n) {
    uvec3 nearest = uvec3(kEnd);
    uint at = first;
    for (int i = 0; i < kLongest && at != kEnd; ++i, at = fragment_list.place[at].next) {
      // Floats above zero are ordered as their bits.
      uvec3 place = uvec3(floatBitsToUint(fragment_list.place[at].distance_mm), fragment_list.place[at].light);
      if (liesBefore(last, place) && liesBefore(place, nearest)) nearest = place;
    }
    if (nearest.x == kEnd) break;
    vec2 red_green = unpackHalf2x16(nearest.y), blue_opacity = unpackHalf2x16(nearest.z);
    colour += (1.0 - colour.a) * blue_opacity.y * vec4(red_green, blue_opacity.x, 1.0);
    last = nearest;
  }
}
