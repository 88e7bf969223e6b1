// Per-eye uniforms in frame P as floats: projection, lamp, face window. std140 twin of eye_block.glsl, computed in
// double precision once per eye and frame. Any thread; pure. The lamp is above the surgeon's head, to one side, aimed
// at the site, the same for both eyes, so that highlights have true parallax.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "render/display/eye_projection.h"
#include "render/frame.h"

namespace render {

struct EyeBlock {
  glm::mat4 clip_from_P;
  glm::vec4 eye_P, lower_left_P, right_edge_P, up_edge_P, lamp_P, lamp_axis_P, up_P, window_eye_P, window_site_P,
      field_P, field_cover, begin_P, glass, curing_P, curing_axis_P;
};
static_assert(sizeof(EyeBlock) == 64 + 15 * 16);

EyeBlock eyeBlock(const Frame& frame, const EyeView& view);

/// What an eye sees in the glass of the second hand's mirror; none: it has none, or shows this eye its back.
std::optional<EyeBlock> reflectedEyeBlock(const Frame& frame, const EyeView& view);
/// Pixels of an image that can show the glass, from its lower left; empty: none.
struct GlassBox {
  glm::ivec2 corner_px{0}, size_px{0};
};
GlassBox glassBox(const Frame& frame, const EyeView& view, glm::ivec2 px);

}  // namespace render
