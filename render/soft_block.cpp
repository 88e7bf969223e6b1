#include "render/soft_block.h"

#include <algorithm>
#include <numbers>

#include "render/shaders/soft_constants.glsl"

namespace render {

SoftBlock softBlock(const SoftMarks& marks) {
  SoftBlock block;
  const std::size_t cuts = std::min(marks.cuts.size(), kMostSoftCuts);
  glm::dvec3 low(1e9), high(-1e9);
  for (std::size_t n = 0; n < cuts; ++n) {
    const SoftCut& cut = marks.cuts[n];
    const glm::dvec3 way = cut.to_P.mm - cut.from_P.mm;
    block.cut_from_P[n] = {glm::vec3(cut.from_P.mm), static_cast<float>(cut.radius_mm)};
    block.cut_way_P[n] = {glm::vec3(way), static_cast<float>(1.0 / std::max(glm::dot(way, way), 1e-6))};
    const double reach_mm = cut.radius_mm + static_cast<double>(SOFT_RIM_WIDTH);
    low = glm::min(low, glm::min(cut.from_P.mm, cut.to_P.mm) - reach_mm);
    high = glm::max(high, glm::max(cut.from_P.mm, cut.to_P.mm) + reach_mm);
  }
  if (cuts > 0) block.bound_P = {glm::vec3(0.5 * (low + high)), static_cast<float>(0.5 * glm::length(high - low))};

  const std::size_t reddened = std::min(marks.reddened.size(), kMostReddened);
  for (std::size_t n = 0; n < reddened; ++n) {
    const Reddened& red = marks.reddened[n];
    const double reach_mm = std::max(red.reach_mm, 1e-3);
    block.reddened_P[n] = {glm::vec3(red.place_P.mm), static_cast<float>(std::numbers::log2e / (reach_mm * reach_mm))};
    block.share[n].x = static_cast<float>(std::clamp(red.share, 0.0, 1.0));
  }
  block.counts = {static_cast<int>(cuts), static_cast<int>(reddened), 0, 0};
  return block;
}

bool haveSameCuts(const SoftBlock& a, const SoftBlock& b) {
  return a.counts.x == b.counts.x && a.cut_from_P == b.cut_from_P && a.cut_way_P == b.cut_way_P;
}

float cutDistance(const SoftBlock& soft, const glm::vec3& p_P) {
  float away = SOFT_FAR;
  if (soft.counts.x == 0 || glm::distance(p_P, glm::vec3(soft.bound_P)) > soft.bound_P.w) return away;
  for (std::size_t n = 0; n < static_cast<std::size_t>(soft.counts.x); ++n) {
    const glm::vec3 offset = p_P - glm::vec3(soft.cut_from_P[n]), way(soft.cut_way_P[n]);
    const float at = glm::clamp(glm::dot(offset, way) * soft.cut_way_P[n].w, 0.0f, 1.0f);
    away = std::min(away, glm::length(offset - at * way) - soft.cut_from_P[n].w);
  }
  return away;
}

}  // namespace render
