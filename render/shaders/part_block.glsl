// Uniforms of a mesh part. C++ twin: render::PartBlock.
#include "shared_constants.glsl"

layout(std140, binding = PART_BLOCK) uniform PartBlock {
  mat4 P_from_mesh;      // rigid
  vec4 base_colour;      // linear, with opacity
  vec4 finish;           // x: roughness, y: metallic, z: FINISH_…, w: PART_CUT_BY_WINDOW + PART_VEIL
} part;
