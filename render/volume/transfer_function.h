// Transfer functions of the translucent views (ViewMode::dvr, ViewMode::clear), for every back-end: with r = ramp(solid
// fraction) opacity per mm = inner r + wall (1 - inner) 4 r (1 - r), below 1. A wall is where matter begins: its term
// is the surface of a tooth and of its canals, whatever lies around. Values chosen by eye on the built-in patient and a
// CT jaw: cortex like frosted glass, roots and crown visible within; clear: a canal and the file in it through crown
// and root. The ramp starts at the drawn surface, so all views skip the same bricks.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "assets/tissue.h"
#include "render/frame.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

/// Solid fractions where opacity begins (at least 0.5, below which bricks count as empty) and, as usual, where it is
/// full.
inline constexpr float kRampStart = 0.5f, kRampFull = 0.9f;
/// 0 … <1, in the order of assets::Tissue.
using OpacityPerMm = std::array<float, assets::kTissueCount>;
struct Transfer {
  OpacityPerMm inner_per_mm{}, wall_per_mm{};
  float full = kRampFull;  ///< where the ramp ends
};
inline constexpr Transfer kFrosted{{0.30f, 0.24f, 0.05f, 0.80f, 0.92f, 0.75f, 0.50f, 0.50f, 0.05f, 0.05f, 0.85f, 0.80f,
                                    0.9f, 0.9f, 0.9f, 0.9f, 0.95f, 0.9f, 0.95f},
                                   {}};
inline constexpr float kWall = 0.9999f;
/// Nothing within: every sample of a wall is lit, which is what the view costs.
inline constexpr Transfer kClear{{},
                                 {0.0f, 0.0f, 0.0f, kWall, kWall, kWall, kWall, 0.0f, 0.0f, 0.0f, kWall, kWall, kWall,
                                  kWall, kWall, kWall, kWall, kWall, kWall},
                                 1.0f};
constexpr const Transfer& transferOf(ViewMode mode) { return mode == ViewMode::clear ? kClear : kFrosted; }

/// Per mm, where `ramp` of the tissue is there.
constexpr double opacityPerMm(float inner, float wall, double ramp) {
  return inner * ramp + wall * (1.0 - inner) * 4.0 * ramp * (1.0 - ramp);
}

/// std140 twin of ray_translucent.glsl.
struct TransferBlock {
  glm::vec4 ramp{0.0f};
  std::array<glm::vec4, assets::kTissueCount> opacity_per_mm{};
};
static_assert(sizeof(TransferBlock) == 16 * (1 + TISSUE_COUNT));

inline TransferBlock transferBlock(const Transfer& transfer) {
  TransferBlock block{.ramp = {kRampStart, 1.0f / (transfer.full - kRampStart), 0.0f, 0.0f}};
  for (std::size_t n = 0; n < block.opacity_per_mm.size(); ++n)
    block.opacity_per_mm[n] = {transfer.inner_per_mm[n], transfer.wall_per_mm[n], 0.0f, 0.0f};
  return block;
}

}  // namespace render
