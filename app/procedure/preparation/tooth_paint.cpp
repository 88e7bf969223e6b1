#include "app/procedure/preparation/tooth_paint.h"

#include <cmath>

namespace app {
namespace {

/// Voxels: a ray's hit reads the eight around it, and lies within a tenth of a place.
constexpr int kSpread = 2;
constexpr double kSpreadRadius = 1.9;

}  // namespace

void PaintBrush::lay(const glm::dvec3& p_P_mm, const glm::dvec3& srgb) {
  const glm::vec3 linear = render::linearFromSrgb(glm::vec3(srgb));
  const glm::dvec3 index = box_.indexFromPoint(p_P_mm);
  const glm::ivec3 middle(glm::floor(index + 0.5));
  assets::forVoxels(glm::max(middle - kSpread, 0), glm::min(middle + kSpread + 1, box_.size), [&](glm::ivec3 ijk) {
    const glm::dvec3 off = glm::dvec3(ijk) - index;
    const double square = glm::dot(off, off);
    if (square > kSpreadRadius * kSpreadRadius) return;
    const auto voxel = static_cast<std::uint32_t>(box_.index(ijk));
    std::int32_t& at = at_[voxel];
    if (at < 0) {
      at = static_cast<std::int32_t>(sums_.size());
      sums_.push_back({glm::vec3(0.0F), 0.0F, voxel});
    }
    Sum& sum = sums_[static_cast<std::size_t>(at)];
    const auto weight = static_cast<float>(1.0 / (0.05 + square));
    sum.linear += weight * linear;
    sum.weight += weight;
  });
}

PaintSpots PaintBrush::spots(float cover) const {
  PaintSpots spots;
  spots.reserve(sums_.size());
  for (const Sum& sum : sums_) spots.push_back({sum.voxel, render::paintTexel(sum.linear / sum.weight, cover)});
  return spots;
}

render::SurfacePaint paintOf(const assets::VolumeGrid& volume, const assets::VolumeGrid& box,
                             std::span<const PaintSpots* const> layers) {
  render::SurfacePaint paint;
  paint.low = glm::ivec3(glm::round(volume.indexFromPoint(box.origin_P_mm)));
  paint.texels = render::PaintTexels(box.size);
  for (const PaintSpots* const layer : layers)
    for (const PaintSpot& spot : *layer) {
      const auto v = static_cast<int>(spot.voxel);
      const glm::ivec3 ijk(v % box.size.x, v / box.size.x % box.size.y, v / box.size.x / box.size.y);
      *paint.texels.at(ijk) = spot.texel;
    }
  return paint;
}

}  // namespace app
