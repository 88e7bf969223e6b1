// Transfer function of the translucent view. C++ twin: render::TransferBlock.
#include "shared_constants.glsl"

layout(std140, binding = TRANSFER_BLOCK) uniform TransferBlock {
  vec4 ramp;                          // x: solid fraction where opacity begins, y: 1 over the length of the ramp
  vec4 opacity_per_mm[TISSUE_COUNT];  // x: of the full tissue
} transfer;
