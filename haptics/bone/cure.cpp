#include "haptics/bone/cure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics {
namespace {

constexpr double kShortestTurn_s = 0.25;  // a dozen units of light
constexpr double kMarch_mm = 0.16;
constexpr unsigned kLightMask = Filling::kMostLight;

}  // namespace

std::int64_t CuringLight::shine(const SolidField& tooth, Filling& filling,
                                const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, double tip_mm,
                                double dt_s, StrokeHistory* strokes) noexcept {
  const assets::VolumeGrid& grid = filling.grid();
  const glm::dmat3 to_T = glm::transpose(glm::mat3_cast(X_PT.rotation));
  const glm::dvec3 axis_P = X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 tip_P = X_PT.translation_mm - tip_mm * axis_P;
  const glm::dvec3 tip = grid.indexFromPoint(tip_P);
  if (!std::isfinite(glm::length(tip)) || filling.isEmpty()) return 0;
  turn_s_ += dt_s;

  const std::size_t count = assets::countIn(size_);
  if (next_ >= count) {
    if (count != 0 && turn_s_ < kShortestTurn_s) return 0;
    // All that the light can reach.
    due_s_ = count == 0 ? 0.0 : std::exchange(turn_s_, 0.0);
    const glm::dvec3 end = grid.indexFromPoint(tip_P - kLampReach_mm * axis_P);
    const VoxelBox box(grid, glm::min(tip, end) - kLampRadius_mm / grid.spacing_mm,
                       glm::max(tip, end) + kLampRadius_mm / grid.spacing_mm);
    next_ = 0;
    first_ = box.first / kBlockEdge;
    size_ = box.empty() ? glm::ivec3(0) : box.last / kBlockEdge - first_ + 1;
    if (box.empty()) return 0;
  }
  std::int64_t steps = 0;
  const SolidField laid = filling.field();
  const std::size_t blocks = assets::countIn(size_);
  int lit = 0;
  for (int n = 0; n < kLookedAtPerTick && next_ < blocks && lit < kBlocksPerTick; ++n, ++next_) {
    const auto at = static_cast<int>(next_);
    const glm::ivec3 block = first_ + glm::ivec3(at % size_.x, at / size_.x % size_.y, at / size_.x / size_.y);
    const std::size_t number = laid.blockAt(block);
    if (laid.weight[laid.slotOf(number)] == 0) continue;
    steps += lightBlock(tooth, filling, number, block, to_T, tip, strokes);
    ++lit;
  }
  return steps;
}

std::int64_t CuringLight::lightBlock(const SolidField& tooth, Filling& filling, std::size_t number, glm::ivec3 block,
                                     const glm::dmat3& to_T, const glm::dvec3& tip,
                                     StrokeHistory* strokes) const noexcept {
  const double spacing_mm = filling.grid().spacing_mm;
  const auto units = static_cast<unsigned>(std::lround(std::min(due_s_, 20.0) / Filling::kLightUnit_s));
  if (units == 0) return 0;
  const SolidField laid = filling.field();
  const glm::dvec3 up = glm::transpose(to_T) * glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 step = kMarch_mm / spacing_mm * up;
  BlockState state = filling.stateOf(number);
  std::int64_t set = 0;
  bool changed = false;
  for (int n = 0; n < kBlockVoxels; ++n) {
    const auto v = static_cast<std::size_t>(n);
    const Setting setting = settingOf(state.reach[v]);
    if (state.solid[v] == 0 || setting.light_s == 0.0) continue;
    const glm::dvec3 here(block * kBlockEdge + glm::ivec3(n & 3, n >> 2 & 3, n >> 4));
    const glm::dvec3 from_tip_mm = spacing_mm * (to_T * (here - tip));
    if (from_tip_mm.z > 0.0 || from_tip_mm.z < -kLampReach_mm ||
        std::hypot(from_tip_mm.x, from_tip_mm.y) > kLampRadius_mm)
      continue;
    // Through what lies between it and the tip.
    double solid_mm = 0.0;
    glm::dvec3 at = here + step;
    for (double way_mm = -from_tip_mm.z - kMarch_mm; way_mm > 0.0 && solid_mm <= kCuredDepth_mm;
         way_mm -= kMarch_mm, at += step) {
      const glm::ivec3 ijk(glm::floor(at + 0.5));
      if (!laid.grid.contains(ijk)) break;
      solid_mm += kMarch_mm / 255.0 * std::min(255, tooth.solidAt(ijk) + laid.solidAt(ijk));
    }
    if (solid_mm > kCuredDepth_mm) continue;
    changed = true;
    const unsigned light = std::min(Filling::kMostLight, (state.dose[v] & kLightMask) + units);
    state.dose[v] = static_cast<std::uint16_t>((state.dose[v] & ~kLightMask) | light);
    if (light * Filling::kLightUnit_s < setting.light_s) continue;
    state.reach[v] = static_cast<std::uint8_t>(setting.into);
    set += state.solid[v];
  }
  if (changed) filling.setBlock(number, state, strokes);
  return set;
}

}  // namespace haptics
