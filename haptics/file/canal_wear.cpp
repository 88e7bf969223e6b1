#include "haptics/file/canal_wear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "haptics/file/material_frame.h"

namespace haptics {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec3;

constexpr int kSweeps = 4;
constexpr std::size_t kMostPressed = 4096;

/// A voxel of a section: how much of it may go, and how deep the file presses there.
struct Pressed {
  std::size_t voxel;
  double may, depth_mm;
};

struct PressedVoxels {
  std::array<Pressed, kMostPressed> of;
  std::size_t count = 0;
};

/// A section's frame and the depth of its rays.
struct PressedSection {
  SectionPlace at;
  dvec3 e1, e2;
  std::array<double, kRays> depth_mm;
};

void addPressed(const PressedSection& section, const assets::VolumeGrid& grid, ivec3 ijk, double left,
                PressedVoxels& list) {
  const SectionPlace& at = section.at;
  const dvec3 away = grid.centre_P_mm(ijk) - at.centre_P_mm;
  if (std::fabs(glm::dot(away, at.axis)) > 0.5 * (at.length_mm + grid.spacing_mm)) return;
  const double x = glm::dot(away, section.e1), y = glm::dot(away, section.e2);
  // As much of the voxel as the file covers may go, in a face as smooth as it is felt.
  const double beyond_mm = std::sqrt(x * x + y * y) - at.radius_mm;
  const double outside = std::clamp(0.5 + 0.5 * beyond_mm / grid.spacing_mm, 0.0, 1.0);
  if (left <= outside || list.count == kMostPressed) return;
  const double ray = (std::atan2(y, x) / (2.0 * std::numbers::pi) + 1.0) * kRays;
  const auto before = static_cast<std::size_t>(ray);
  const double share = ray - static_cast<double>(before);
  const double deep_mm =
      (1.0 - share) * section.depth_mm[before % kRays] + share * section.depth_mm[(before + 1) % kRays];
  if (deep_mm > 0.0) list.of[list.count++] = {grid.index(ijk), left - outside, deep_mm};
}

}  // namespace

double wornVolume_mm3(const WearSettings& settings, double normal_N, double touched_mm2, const dvec2& slip_mm,
                      double radius_mm, double lead_mm) noexcept {
  const double tangent = 2.0 * std::numbers::pi * radius_mm / lead_mm,
               cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const double across_mm = std::fabs(slip_mm.x * tangent * cosine - slip_mm.y * cosine);
  const double eta = slip_mm.x > 0.0 ? settings.push_share : 1.0;
  switch (settings.law) {
    case WearLaw::wear:
      return settings.alpha_mm3_per_Nmm * normal_N * across_mm * eta;
    case WearLaw::counters:
      return settings.counter * touched_mm2 * std::fabs(slip_mm.x);
    case WearLaw::counters_helical:
      return settings.counter * touched_mm2 * across_mm;
  }
  return 0.0;
}

CanalWear::CanalWear(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, const WearSettings& settings)
    : grid_(grid), settings_(settings), left_(solid.size()), cubelets_(grid, solid, {}) {
  std::transform(solid.begin(), solid.end(), left_.begin(),
                 [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0F; });
}

void CanalWear::step(const FileInCanal& file) noexcept {
  const FileChain& chain = file.chain();
  const FileState& state = file.state();
  const SolidField field = wall();
  for (std::size_t i = 1; i <= chain.links; ++i) {
    const double normal_N = state.normal_N[i];
    if (normal_N <= 0.0) continue;
    const bool is_tip = i == chain.links;
    const dvec3& d = state.shape.direction[i];
    const SectionPlace at{state.shape.node_mm[i], is_tip ? d : unitOf(d + state.shape.direction[i + 1]),
                          chain.radius_mm[i], is_tip ? 0.5 * chain.link_mm : chain.link_mm};
    std::array<double, kRays> depth_mm{};
    if (!rayDepths(file.law(), field, at, depth_mm)) continue;
    const auto touching = std::count_if(depth_mm.begin(), depth_mm.end(), [](double depth) { return depth > 0.0; });
    const double touched_mm2 =
        static_cast<double>(touching) / kRays * 2.0 * std::numbers::pi * at.radius_mm * at.length_mm;
    const double worn_mm3 =
        wornVolume_mm3(settings_, normal_N, touched_mm2, state.slip_mm[i], at.radius_mm, chain.lead_mm);
    due_mm3_ += worn_mm3;
    const double removed_mm3 = take(file.law(), at, worn_mm3 + carried_mm3_[i]);
    carried_mm3_[i] += worn_mm3 - removed_mm3;
    removed_mm3_ += removed_mm3;
  }
}

double CanalWear::take(const FileLaw& law, const SectionPlace& at, double volume_mm3) noexcept {
  if (volume_mm3 <= 0.0) return 0.0;
  const std::array<dvec3, kRays> rays = raysAbout(at.axis);
  PressedSection section{at, rays[0], rays[kRays / 4], {}};
  if (!rayDepths(law, wall(), at, section.depth_mm)) return 0.0;
  const dvec3 aside = at.radius_mm * glm::sqrt(glm::max(dvec3(0.0), 1.0 - at.axis * at.axis));
  const dvec3 reach = aside + 0.5 * at.length_mm * glm::abs(at.axis) + 2.0 * grid_.spacing_mm;
  const dvec3 from = grid_.indexFromPoint(at.centre_P_mm - reach), to = grid_.indexFromPoint(at.centre_P_mm + reach);
  const ivec3 low = glm::max(ivec3(glm::floor(from)), ivec3(0)), high = glm::min(ivec3(glm::ceil(to)) + 1, grid_.size);
  if (glm::any(glm::lessThanEqual(high, low))) return 0.0;
  PressedVoxels list;
  assets::forVoxels(low, high, [&](ivec3 ijk) {
    const double left = static_cast<double>(left_[grid_.index(ijk)]);
    if (left > 0.0) addPressed(section, grid_, ijk, left, list);
  });

  // By depth and by what may go; where that is less than its part, the others take more.
  const double voxel_mm3 = grid_.voxelVolume_mm3();
  double taken_mm3 = 0.0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const double open = (volume_mm3 - taken_mm3) / voxel_mm3;
    double weights = 0.0;
    for (std::size_t n = 0; n < list.count; ++n) weights += list.of[n].may * list.of[n].depth_mm;
    if (weights <= 0.0 || open <= 1e-12) break;
    for (std::size_t n = 0; n < list.count; ++n) {
      Pressed& one = list.of[n];
      float& left = left_[one.voxel];
      const double share = std::min(one.may, open * one.may * one.depth_mm / weights);
      const float after = std::max(0.0F, static_cast<float>(static_cast<double>(left) - share));
      const double gone = static_cast<double>(left) - static_cast<double>(after);
      one.may = std::max(0.0, one.may - gone);
      taken_mm3 += gone * voxel_mm3;
      left = after;
    }
  }
  if (taken_mm3 > 0.0) store(low, high);
  return taken_mm3;
}

void CanalWear::store(ivec3 low, ivec3 high) noexcept {
  const SolidField field = wall();
  assets::forVoxels(low / kBlockEdge, (high + (kBlockEdge - 1)) / kBlockEdge, [&](ivec3 block) {
    std::array<std::uint8_t, kBlockVoxels> bytes{};
    const std::size_t at = field.blockAt(block);
    bool is_changed = false;
    std::size_t v = 0;
    assets::forVoxels(ivec3(0), ivec3(kBlockEdge), [&](ivec3 within) {
      const ivec3 ijk = kBlockEdge * block + within;
      const std::uint8_t was = field.solid[at * kBlockVoxels + v];
      bytes[v] = grid_.contains(ijk)
                     ? static_cast<std::uint8_t>(std::lround(255.0 * static_cast<double>(left_[grid_.index(ijk)])))
                     : was;
      is_changed = is_changed || bytes[v] != was;
      ++v;
    });
    if (is_changed) cubelets_.setBlock(at, bytes);
  });
}

}  // namespace haptics
