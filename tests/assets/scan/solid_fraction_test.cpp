#include "assets/scan/solid_fraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "assets/load_error.h"

namespace {

using assets::Classification;
using assets::classify;
using assets::solidFromHounsfield;
using assets::VolumeGrid;

// A face normal to `normal` through the middle: HU rises linearly over `width_voxels`, from 0 to 1000.
std::vector<std::int16_t> faceOf(const VolumeGrid& grid, const glm::dvec3& normal, double width_voxels) {
  std::vector<std::int16_t> hounsfield(grid.voxelCount());
  const glm::dvec3 middle = glm::dvec3(grid.size - 1) / 2.0;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const double depth = glm::dot(glm::dvec3(i, j, k) - middle, normal) / width_voxels;
        hounsfield[grid.index({i, j, k})] =
            static_cast<std::int16_t>(std::lround(1000.0 * std::clamp(depth + 0.5, 0.0, 1.0)));
      }
  return hounsfield;
}

TEST(SolidFraction, IsTheNormalDistributionOfGrey) {
  // Phi(0) = 1/2, Phi(1) = 0.841345, Phi(-2) = 0.0227501.
  const auto solid = solidFromHounsfield({300, 375, 150, 301, -32768, 32767}, {300.0, 75.0});
  EXPECT_EQ(solid, (std::vector<std::uint8_t>{128, 215, 6, 129, 0, 255}));
}

TEST(SolidFraction, RefusesAClassificationWithoutWidth) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Classification bad : {Classification{300, 0}, {300, -1}, {nan, 75}, {300, nan}}) {
    EXPECT_THROW(solidFromHounsfield({0}, bad), assets::LoadError);
    EXPECT_THROW(classify({{1, 1, 1}, 0.1}, {0}, bad), assets::LoadError);
  }
}

TEST(SolidFraction, KeepsTheFormulaWhereGreyRisesSlowly) {
  const VolumeGrid grid{{20, 8, 8}, 0.4};
  const auto hounsfield = faceOf(grid, {1, 0, 0}, 16.0);
  EXPECT_EQ(classify(grid, hounsfield, {300, 75}), solidFromHounsfield(hounsfield, {300, 75}));
}

TEST(SolidFraction, NeverRisesFasterThanOnePerVoxel) {
  const VolumeGrid grid{{24, 24, 24}, 0.4};
  std::mt19937 random(7);
  std::normal_distribution<double> component;
  for (int trial = 0; trial < 20; ++trial) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(component(random), component(random), component(random)));
    const auto hounsfield = faceOf(grid, normal, 3.0);
    const auto solid = classify(grid, hounsfield, {500, 20});
    double steepest = 0.0;
    for (int k = 0; k < 23; ++k)
      for (int j = 0; j < 23; ++j)
        for (int i = 0; i < 23; ++i) {
          const auto rise = [&](glm::ivec3 a) {
            return (solid[grid.index(glm::ivec3{i, j, k} + a)] - solid[grid.index({i, j, k})]) / 255.0;
          };
          steepest = std::max(steepest, glm::length(glm::dvec3(rise({1, 0, 0}), rise({0, 1, 0}), rise({0, 0, 1}))));
        }
    EXPECT_LE(steepest, 1.0 + 1.0 / 255.0);
  }
}

TEST(SolidFraction, WidensAStepToGreyValues) {
  // Rise 1000/3 HU per voxel: sigma_eff = 333/sqrt(2 pi) = 133, so solid at a third of a voxel is Phi(1/3 * 333/133).
  const VolumeGrid grid{{12, 4, 4}, 0.1};
  const auto hounsfield = faceOf(grid, {1, 0, 0}, 3.0);
  const auto solid = classify(grid, hounsfield, {500, 5});
  const auto plain = solidFromHounsfield(hounsfield, {500, 5});
  const std::size_t below = grid.index({5, 2, 2});  // half a voxel below the surface: 500 - 167 HU
  EXPECT_EQ(plain[below], 0);
  EXPECT_EQ(solid[below],
            std::lround(255.0 * 0.5 * std::erfc(0.5 * std::sqrt(std::numbers::pi))));  // Phi(-sqrt(2 pi)/2)
}

TEST(SolidFraction, KeepsTheSurfaceAtIso) {
  const VolumeGrid grid{{16, 16, 16}, 0.4};
  const auto hounsfield = faceOf(grid, glm::normalize(glm::dvec3(1, 2, 3)), 4.0);
  const auto solid = classify(grid, hounsfield, {300, 75});
  for (std::size_t v = 0; v < solid.size(); ++v) EXPECT_EQ(solid[v] >= 128, hounsfield[v] >= 300) << hounsfield[v];
}

TEST(SolidFraction, AcceptsAVolumeOfOneVoxel) {
  EXPECT_EQ(classify({{1, 1, 1}, 0.1}, {300}, {300, 75}), std::vector<std::uint8_t>{128});
}

}  // namespace
