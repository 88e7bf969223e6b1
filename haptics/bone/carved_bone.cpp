#include "haptics/bone/carved_bone.h"

#include <algorithm>
#include <atomic>
#include <cassert>

namespace haptics {
namespace {

constexpr std::uint32_t kFullDose = 65535;
constexpr std::uint32_t kDosePerReach = kFullDose / 255;  // 257 exactly

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection that spreads every bit.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

constexpr double kPerWord = 1.0 / 4294967296.0;
constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15u;

/// One voxel's part of the bone's digest.
std::uint64_t stateDigest(std::size_t voxel, std::uint32_t solid, std::uint32_t reach, std::uint32_t dose) {
  return mixed((static_cast<std::uint64_t>(voxel) << 32) ^ ((solid << 24) | (reach << 16) | dose));
}

}  // namespace

CarvedBone::CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                       std::span<const std::uint8_t> label)
    : grid_(grid),
      solid_(solid.begin(), solid.end()),
      first_solid_(solid_),
      label_(label.begin(), label.end()),
      reach_(solid_.size(), 0),
      dose_(solid_.size(), 0),
      dirty_(grid.bricks()) {
  assert(solid.size() == grid.voxelCount());
  assert(label.empty() || label.size() == grid.voxelCount());
  for (std::size_t voxel = 0; voxel < solid_.size(); ++voxel) digest_ += stateDigest(voxel, solid_[voxel], 0, 0);
}

int CarvedBone::remove(std::size_t voxel, double coverage, double loss, std::uint64_t tick) {
  const std::uint8_t before = solid_[voxel];
  if (before == 0) return 0;

  // A bur reaches no further into a voxel than it has ever covered of it.
  const auto covered = static_cast<std::uint8_t>(std::clamp(coverage, 0.0, 1.0) * 255.0 + 0.5);
  const std::uint8_t old_reach = reach_[voxel], reach = std::max(old_reach, covered);
  const std::uint32_t dose = dose_[voxel], cap = std::max(dose, reach * kDosePerReach);
  if (cap == dose) return 0;

  // Golden-ratio steps from a start of the voxel's own: the rounded sum stays within a few steps of the true one.
  const std::uint64_t hash = mixed(voxel + 1);
  const double dither = static_cast<double>((hash + tick * kGoldenRatio) >> 32) * kPerWord;
  const auto step = static_cast<std::uint32_t>(std::clamp(loss, 0.0, 1.0) * kFullDose + dither);
  const std::uint32_t new_dose = std::min(dose + step, cap);
  if (new_dose == dose && reach == old_reach) return 0;

  // What is left, rounded at the voxel's own threshold: never rises again, and right on average over voxels.
  const std::uint32_t threshold = static_cast<std::uint32_t>(hash & 0xFFFF) % kFullDose;
  const std::uint32_t left = first_solid_[voxel] * (kFullDose - new_dose) + threshold;
  const auto after = static_cast<std::uint8_t>(left / kFullDose);

  dose_[voxel] = static_cast<std::uint16_t>(new_dose);
  reach_[voxel] = reach;
  if (after != before) std::atomic_ref<std::uint8_t>(solid_[voxel]).store(after, std::memory_order_relaxed);
  digest_ += stateDigest(voxel, after, reach, new_dose) - stateDigest(voxel, before, old_reach, dose);
  return before - after;
}

std::array<double, assets::kTissueCount> CarvedBone::removedByTissue_mm3() const {
  std::array<std::int64_t, assets::kTissueCount> steps{};
  for (std::size_t voxel = 0; voxel < solid_.size(); ++voxel) {
    const std::size_t tissue = label(voxel) < assets::kTissueCount ? label(voxel) : 0;
    steps[tissue] += first_solid_[voxel] - solid_[voxel];
  }
  std::array<double, assets::kTissueCount> removed_mm3{};
  for (std::size_t tissue = 0; tissue < steps.size(); ++tissue)
    removed_mm3[tissue] = static_cast<double>(steps[tissue]) * grid_.voxelVolume_mm3() / 255.0;
  return removed_mm3;
}

void CarvedBone::copyBrick(glm::ivec3 brick, std::span<std::uint8_t, 512> solid_out) const {
  const glm::ivec3 corner = brick * assets::kBrickVoxels;
  std::size_t out = 0;
  for (int k = 0; k < assets::kBrickVoxels; ++k)
    for (int j = 0; j < assets::kBrickVoxels; ++j)
      for (int i = 0; i < assets::kBrickVoxels; ++i, ++out) {
        const glm::ivec3 ijk = corner + glm::ivec3(i, j, k);
        // The atomic view needs a mutable reference; nothing is written through it.
        solid_out[out] = grid_.contains(ijk)
                             ? std::atomic_ref<std::uint8_t>(const_cast<std::uint8_t&>(solid_[grid_.index(ijk)]))
                                   .load(std::memory_order_relaxed)
                             : std::uint8_t{0};
      }
}

}  // namespace haptics
