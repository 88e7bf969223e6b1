// Uniforms of the instrument, in frame P as floats: the round parts that shade the patient, and the ring on the bone
// whose colour and width tell the gap. std140 twin of tool_block.glsl, computed once a frame. Any thread; pure.
// The parts lie on the axis of the tool: head, shank, nose and body of the handpiece (assets/instrument/handpiece).
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/frame.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

struct ToolBlock {
  std::array<glm::vec4, TOOL_PARTS> from_P{}, to_P{};  ///< ends of the axis; w: radius there. The first radius 0: none
  glm::vec4 ring_P{0.0f};                              ///< centre; w: radius, 0: no ring
  glm::vec4 ring_axis_P{0.0f};                         ///< unit, from the bone to the bur; w: opacity
  glm::vec4 ring_colour{0.0f};                         ///< linear
};
static_assert(sizeof(ToolBlock) == 2 * TOOL_PARTS * 16 + 3 * 16);

ToolBlock toolBlock(const Frame& frame);

/// Colour of a gap, linear: red in contact, orange, yellow, and blue far away; differs in lightness as well as in hue.
glm::vec3 colourOfGap(double gap_mm);

}  // namespace render
