// Uniforms of the marks on soft tissue, in frame P as floats. std140 twin of soft_block.glsl, computed once a frame.
// Any thread; pure, some microseconds.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/shaders/shared_constants.glsl"
#include "render/soft_marks.h"

namespace render {

struct SoftBlock {
  glm::ivec4 counts{0};                               ///< cuts, reddened places
  glm::vec4 bound_P{0.0f};                            ///< ball around all cuts and their rims; w: radius
  std::array<glm::vec4, SOFT_CUTS> cut_from_P{};      ///< w: radius
  std::array<glm::vec4, SOFT_CUTS> cut_way_P{};       ///< to its other end; w: 1 / squared length
  std::array<glm::vec4, SOFT_REDDENED> reddened_P{};  ///< w: 1 / (ln 2 · reach²)
  std::array<glm::vec4, SOFT_REDDENED> share{};       ///< x
};
static_assert(sizeof(SoftBlock) == 2 * 16 + 2 * SOFT_CUTS * 16 + 2 * SOFT_REDDENED * 16);
static_assert(kMostSoftCuts == SOFT_CUTS && kMostReddened == SOFT_REDDENED);

SoftBlock softBlock(const SoftMarks& marks);

/// Whether both take away the same.
bool haveSameCuts(const SoftBlock& a, const SoftBlock& b);

/// mm from the surface of the nearest cut, negative inside; SOFT_FAR away from all of them. Twin of soft_marks.glsl.
float cutDistance(const SoftBlock& soft, const glm::vec3& p_P);

}  // namespace render
