// Uniforms of the instrument. Frame P, mm; C++ twin: render::ToolBlock.
#include "shared_constants.glsl"

layout(std140, binding = TOOL_BLOCK) uniform ToolBlock {
  vec4 from_P[TOOL_PARTS];  // ends of round parts; w: radius there. The first radius 0: no shade
  vec4 to_P[TOOL_PARTS];
  vec4 ring_P;              // centre; w: radius, 0: no ring
  vec4 ring_axis_P;         // unit, from the bone to the bur; w: opacity
  vec4 ring_colour;
} tool;
