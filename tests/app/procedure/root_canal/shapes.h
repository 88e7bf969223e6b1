// Fields of closed forms for the measures of a root canal treatment: depth in mm, positive in solid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "app/procedure/root_canal/fine_solid.h"
#include "assets/tissue.h"
#include "assets/tooth_canals.h"
#include "assets/tooth_sampler.h"

namespace app::shapes {

using Depth = std::function<double(const glm::dvec3&)>;
using Label = std::function<assets::Tissue(const glm::dvec3&)>;

inline assets::VolumeGrid gridOf(const glm::dvec3& low, const glm::dvec3& high, double spacing_mm) {
  return {(glm::ivec3(glm::ceil((high - low) / spacing_mm)) + 4) / 4 * 4, spacing_mm, low};
}

inline std::uint8_t bytesOf(double depth_mm, double spacing_mm) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(0.5 + depth_mm / spacing_mm, 0.0, 1.0)));
}

class ShapeSolid final : public FineSolid {
 public:
  ShapeSolid(const assets::VolumeGrid& grid, const Depth& depth) : grid_(grid), blocks_(grid.size / 4) {
    bytes_.resize(assets::countIn(blocks_));
    assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t) {
      bytes_[assets::indexIn(blocks_, ijk / 4)][within(ijk)] = bytesOf(depth(grid.centre_P_mm(ijk)), grid.spacing_mm);
    });
  }
  const assets::VolumeGrid& grid() const override { return grid_; }
  Block block(glm::ivec3 block) const override { return {bytes_[assets::indexIn(blocks_, block)].data(), 0}; }

 private:
  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::array<std::uint8_t, kVoxels>> bytes_;
};

class ShapeTooth final : public assets::ToothSampler {
 public:
  ShapeTooth(const assets::VolumeGrid& grid, Depth depth, Label label)
      : grid_(grid), depth_(std::move(depth)), label_(std::move(label)) {}
  const assets::VolumeGrid& grid() const override { return grid_; }
  std::optional<Same> same(glm::ivec3, int) const override { return std::nullopt; }
  void block(glm::ivec3 block, std::span<std::uint8_t, kVoxels> solid,
             std::span<std::uint8_t, kVoxels> label) const override {
    std::size_t v = 0;
    assets::forVoxels(4 * block, 4 * block + 4, [&](glm::ivec3 ijk) {
      const glm::dvec3 p = grid_.centre_P_mm(ijk);
      solid[v] = bytesOf(depth_(p), grid_.spacing_mm);
      label[v++] = static_cast<std::uint8_t>(label_(p));
    });
  }

 private:
  assets::VolumeGrid grid_;
  Depth depth_;
  Label label_;
};

/// Down -z from `top`.
inline assets::ToothCanal straightCanal(double length_mm, double radius_mm, const glm::dvec3& top = glm::dvec3(0.0)) {
  assets::ToothCanal canal;
  canal.name = "straight";
  for (double mm = 0.0; mm <= length_mm + 1e-9; mm += 0.2)
    canal.places.push_back({top - glm::dvec3(0.0, 0.0, mm), mm, radius_mm, radius_mm});
  canal.constriction_mm = length_mm - 1.0;
  canal.reference_P_mm = top + glm::dvec3(0.0, 0.0, 7.0);
  return canal;
}

/// Common area of circles of radius a and b whose middles are e apart.
inline double lens_mm2(double a, double b, double e) {
  const double at_a = std::acos(std::clamp((e * e + a * a - b * b) / (2.0 * e * a), -1.0, 1.0));
  const double at_b = std::acos(std::clamp((e * e + b * b - a * a) / (2.0 * e * b), -1.0, 1.0));
  return a * a * (at_a - 0.5 * std::sin(2.0 * at_a)) + b * b * (at_b - 0.5 * std::sin(2.0 * at_b));
}

}  // namespace app::shapes
