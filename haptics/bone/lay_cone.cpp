#include "haptics/bone/lay_cone.h"

#include <algorithm>
#include <cmath>

#include "haptics/bone/laid_voxel.h"
#include "haptics/bone/stroke_history.h"

namespace haptics {
namespace {

using glm::dvec3;

constexpr int kWhole = 255;

/// Of a voxel that a face passes at this distance, outside positive.
double shareInside(double distance_mm, double spacing_mm) {
  const double share = 0.5 - distance_mm / spacing_mm;
  return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

/// From the middle of a block to its corners.
double halfBlock_mm(const assets::VolumeGrid& grid) { return 0.5 * std::sqrt(3.0) * kBlockEdge * grid.spacing_mm; }

bool isSound(const LaidCone& cone) {
  bool is = cone.nodes >= 2 && cone.nodes <= LaidCone::kMostNodes && std::isfinite(cone.coat_mm) &&
            std::isfinite(cone.sealer_mm3) && std::isfinite(glm::dot(cone.seared_P_mm, cone.out_P));
  for (std::size_t n = 0; is && n < cone.nodes; ++n)
    is = std::isfinite(glm::dot(cone.node_P_mm[n], dvec3(1.0))) && cone.radius_mm[n] > 0.0 && cone.radius_mm[n] < 2.0;
  return is;
}

}  // namespace

void ConeLaying::begin(const LaidCone& cone, unsigned increment) noexcept {
  link_ = 0;
  if (!isSound(cone)) return;
  cone_ = cone;
  cone_.coat_mm = std::clamp(cone.coat_mm, 0.0, 1.0);
  increment_ = increment;
  sealer_left_mm3_ = std::max(0.0, cone.sealer_mm3);
  // Beyond the tip's: the first one opens it.
  link_ = cone.nodes;
  size_ = glm::ivec3(0), next_ = 0;
}

/// To the surface of one link, a round cone; that of the tip is flat at its end.
double ConeLaying::distance_mm(const dvec3& p_P_mm, std::size_t link) const noexcept {
  const dvec3 &a = cone_.node_P_mm[link - 1], way = cone_.node_P_mm[link] - a;
  const double length2 = std::max(glm::dot(way, way), 1e-12);
  const double t = glm::dot(p_P_mm - a, way) / length2;
  const bool is_tip = link + 1 == cone_.nodes;
  const double on = std::clamp(t, 0.0, is_tip && t > 1.0 ? t : 1.0);
  const double radius_mm =
      cone_.radius_mm[link - 1] + std::min(on, 1.0) * (cone_.radius_mm[link] - cone_.radius_mm[link - 1]);
  const dvec3 aside = p_P_mm - a - on * way;
  const double beside_mm = std::sqrt(glm::dot(aside, aside)) - radius_mm;
  return is_tip ? std::max(beside_mm, (t - 1.0) * std::sqrt(length2)) : beside_mm;
}

ConeLaying::Cover ConeLaying::coverAt(const dvec3& p_P_mm, double spacing_mm) const noexcept {
  // Of this link and those beside it.
  double distance = distance_mm(p_P_mm, link_);
  if (link_ > 1) distance = std::min(distance, distance_mm(p_P_mm, link_ - 1));
  if (link_ + 1 < cone_.nodes) distance = std::min(distance, distance_mm(p_P_mm, link_ + 1));
  const double below = shareInside(glm::dot(p_P_mm - cone_.seared_P_mm, cone_.out_P), spacing_mm);
  return {below * shareInside(distance, spacing_mm), below * shareInside(distance - cone_.coat_mm, spacing_mm)};
}

/// False: nothing of it is air that the cone covers.
bool ConeLaying::layBlock(const SolidField& tooth, Filling& filling, glm::ivec3 block, std::int64_t& laid,
                          StrokeHistory* strokes) noexcept {
  const assets::VolumeGrid& grid = filling.grid();
  const std::size_t number = tooth.blockAt(block);
  const std::uint8_t* const solid = tooth.solid + tooth.slotOf(number) * kBlockVoxels;
  const double step_mm3 = grid.voxelVolume_mm3() / kWhole;
  const auto material = static_cast<std::uint8_t>(assets::Tissue::gutta_percha);
  BlockState state = filling.stateOf(number);
  std::int64_t here = 0;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    const int at = static_cast<int>(n), room = kWhole - solid[n] - state.solid[n];
    const glm::ivec3 ijk = block * kBlockEdge + glm::ivec3(at & 3, at >> 2 & 3, at >> 4);
    if (room <= 0 || !grid.contains(ijk)) continue;
    const Cover cover = coverAt(grid.centre_P_mm(ijk), grid.spacing_mm);
    const int core = std::min(room, static_cast<int>(kWhole * cover.core + 0.5));
    int sealer = std::min(room, static_cast<int>(kWhole * cover.all + 0.5)) - core;
    sealer = std::min(sealer, static_cast<int>(std::min(255.0, sealer_left_mm3_ / step_mm3)));
    sealer_left_mm3_ -= sealer * step_mm3;
    addLaid(state, n, core + sealer, material, markOf(increment_));
    here += core + sealer;
  }
  if (here == 0) return false;
  if (filling.setBlock(number, state, strokes)) laid += here;
  return true;
}

void ConeLaying::openLink(const Filling& filling) noexcept {
  const assets::VolumeGrid& grid = filling.grid();
  const double reach_mm = std::max(cone_.radius_mm[link_ - 1], cone_.radius_mm[link_]) + cone_.coat_mm;
  const dvec3 &a = cone_.node_P_mm[link_ - 1], &b = cone_.node_P_mm[link_];
  const double margin = (reach_mm + halfBlock_mm(grid)) / grid.spacing_mm;
  const VoxelBox box(grid, grid.indexFromPoint(glm::min(a, b)) - margin, grid.indexFromPoint(glm::max(a, b)) + margin);
  next_ = 0;
  size_ = glm::ivec3(0);
  if (box.empty()) return;
  first_ = box.first / kBlockEdge;
  size_ = box.last / kBlockEdge + 1 - first_;
}

std::int64_t ConeLaying::step(const SolidField& tooth, Filling& filling, StrokeHistory* strokes) noexcept {
  std::int64_t laid = 0;
  const assets::VolumeGrid& grid = filling.grid();
  const double reach_mm = cone_.coat_mm + halfBlock_mm(grid);
  const auto is_near = [&](const dvec3& middle_P_mm, std::size_t link) {
    return distance_mm(middle_P_mm, link) <= reach_mm;
  };
  int work = 0;
  for (int looked = 0; isRunning() && looked < kLookedAtPerTick && work < kBlocksPerTick; ++looked) {
    const std::size_t blocks =
        static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z);
    if (next_ >= blocks) {
      if (--link_ != 0) openLink(filling);
      continue;
    }
    const auto at = static_cast<int>(next_++);
    const glm::ivec3 block = first_ + glm::ivec3(at % size_.x, at / size_.x % size_.y, at / size_.x / size_.y);
    const dvec3 middle_P_mm = grid.centre_P_mm(block * kBlockEdge) + 0.5 * (kBlockEdge - 1) * grid.spacing_mm;
    if (!is_near(middle_P_mm, link_)) continue;
    // Each block once: that of the link nearest to the tip.
    bool is_done = false;
    for (std::size_t link = link_ + 1; !is_done && link < cone_.nodes; ++link) is_done = is_near(middle_P_mm, link);
    if (is_done) continue;
    layBlock(tooth, filling, block, laid, strokes);
    ++work;
  }
  return laid;
}

}  // namespace haptics
