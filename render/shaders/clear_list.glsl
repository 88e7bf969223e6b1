// What is transparent before each pixel, as lists that are sorted when all of it is known. Yang et al., "Real-time
// concurrent linked list construction on the GPU" (EGSR 2010).
#include "shared_numbers.glsl"

const uint kEnd = 0xffffffffu;

struct ClearPlace {
  uvec2 light;         // four halves: colour, not premultiplied, and opacity
  float distance_mm;
  uint next;
};

layout(std430, binding = CLEAR_LIST) buffer ClearList {
  uint count;
  uint capacity;
  ClearPlace place[];
} clear_list;

layout(binding = CLEAR_HEADS_IMAGE, r32ui) uniform uimage2D clear_heads;
