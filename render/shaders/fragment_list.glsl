// Linked lists of transparent fragments, one per pixel. Yang et al., "Real-time concurrent linked list construction on
// the GPU" (EGSR 2010).
#include "shared_constants.glsl"

const uint kEnd = 0xffffffffu;
// The sign of blue: a fragment of the faded face, of which only the nearest counts.
const uint kVeilBit = 0x8000u;

struct Fragment {
  uvec2 light;         // four halves: colour (not premultiplied) and opacity; negative: drawn only where hidden
  float distance_mm;
  uint next;
};

layout(std430, binding = FRAGMENT_LIST) buffer FragmentList {
  uint count;
  uint capacity;
  Fragment fragment[];
} fragment_list;

layout(binding = FRAGMENT_HEADS_IMAGE, r32ui) uniform uimage2D fragment_heads;
