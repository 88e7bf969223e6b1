// Transfer function of the translucent view (ViewMode::dvr), for every back-end: opacity per mm = ramp(solid fraction)
// times the opacity of the tissue. Values chosen by eye on the built-in patient and a CT jaw: cortex like frosted
// glass, roots and crown visible within. The ramp starts at the drawn surface, so both views skip the same bricks.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "assets/tissue.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

/// Solid fractions where opacity begins (at least 0.5, below which bricks count as empty) and where it is full.
inline constexpr float kRampStart = 0.5f, kRampFull = 0.9f;
/// 0 … <1, in the order of assets::Tissue.
inline constexpr std::array<float, assets::kTissueCount> kOpacityPerMm{0.30f, 0.24f, 0.05f, 0.80f, 0.92f,
                                                                       0.75f, 0.50f, 0.50f, 0.05f, 0.05f};

/// std140 twin of ray_translucent.glsl.
struct TransferBlock {
  glm::vec4 ramp{0.0f};
  std::array<glm::vec4, assets::kTissueCount> opacity_per_mm{};
};
static_assert(sizeof(TransferBlock) == 16 * (1 + TISSUE_COUNT));

inline TransferBlock transferBlock() {
  TransferBlock block{.ramp = {kRampStart, 1.0f / (kRampFull - kRampStart), 0.0f, 0.0f}};
  for (std::size_t n = 0; n < kOpacityPerMm.size(); ++n) block.opacity_per_mm[n].x = kOpacityPerMm[n];
  return block;
}

}  // namespace render
