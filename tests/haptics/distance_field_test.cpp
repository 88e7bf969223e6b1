#include "haptics/body/distance_field.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/haptics/tooth_phantom.h"

namespace haptics {
namespace {

using phantom::softEdge;
using phantom::ToothPhantom;

ToothPhantom ball(double radius_mm, double spacing_mm) {
  ToothPhantom tooth(glm::ivec3(static_cast<int>(20.0 / spacing_mm)), spacing_mm);
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    tooth.solid[v] = softEdge(glm::length(tooth.grid.centre_P_mm(ijk)) - radius_mm, spacing_mm);
  });
  return tooth;
}

TEST(DistanceField, OfABallIsWithinAThirdOfAVoxel) {
  for (const double spacing_mm : {0.2, 0.3}) {
    const ToothPhantom tooth = ball(6.03, spacing_mm);
    const DistanceField field(tooth.grid, tooth.solid, 1.6);
    double worst_mm = 0.0;
    assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double d_mm = glm::length(tooth.grid.centre_P_mm(ijk)) - 6.03;
      if (std::abs(d_mm) < 1.2) worst_mm = std::max(worst_mm, std::abs(static_cast<double>(field.atVoxel(v)) - d_mm));
    });
    EXPECT_LT(worst_mm, spacing_mm / 3.0 + 0.01);
    EXPECT_GT(worst_mm, 0.0);
  }
}

TEST(DistanceField, OfAFlatFaceIsWithinATenthOfAVoxel) {
  ToothPhantom tooth({20, 20, 40}, 0.25);
  constexpr double kHeight_mm = 0.31;
  assets::forVoxels(tooth.grid, [&](glm::ivec3 ijk, std::size_t v) {
    tooth.solid[v] = softEdge(tooth.grid.centre_P_mm(ijk).z - kHeight_mm, 0.25);
  });
  const DistanceField field(tooth.grid, tooth.solid, 2.0);
  for (double z_mm = -1.5; z_mm < 1.9; z_mm += 0.07) {
    const DistanceField::Sample there = field.at(glm::vec3(tooth.grid.indexFromPoint({0.4, -0.3, z_mm})));
    EXPECT_NEAR(there.distance_mm, z_mm - kHeight_mm, 0.025) << z_mm;
    EXPECT_NEAR(there.gradient.z, 1.0F, 0.02F);
    EXPECT_NEAR(there.gradient.x, 0.0F, 1e-4F);
  }
  EXPECT_FLOAT_EQ(field.at({10.0F, 10.0F, 39.0F}).distance_mm, 2.0F) << "the band";
  EXPECT_FLOAT_EQ(field.at({-50.0F, 10.0F, 90.0F}).distance_mm, 2.0F) << "beyond the grid: its nearest place";
}

TEST(DistanceField, ItsGradientIsThatOfItsValues) {
  const ToothPhantom tooth = ball(5.0, 0.25);
  const DistanceField field(tooth.grid, tooth.solid, 2.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> index(20.0F, 58.0F);
  for (int n = 0; n < 200; ++n) {
    const glm::vec3 at = glm::floor(glm::vec3(index(random), index(random), index(random))) + 0.5F;
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 step(0.0F);
      step[axis] = 0.25F;
      const float slope = (field.at(at + step).distance_mm - field.at(at - step).distance_mm) / (0.5F * 0.25F);
      EXPECT_NEAR(field.at(at).gradient[axis], slope, 1e-3F);
    }
    EXPECT_LT(std::abs(field.near(at + 0.4F) - field.at(at + 0.4F).distance_mm), 0.87F * 0.25F);
  }
}

TEST(DistanceField, OfNothingIsTheBand) {
  const ToothPhantom air({9, 8, 7}, 0.3);
  const DistanceField field(air.grid, air.solid, 1.5);
  for (std::size_t v = 0; v < air.grid.voxelCount(); ++v) EXPECT_FLOAT_EQ(field.atVoxel(v), 1.5F);
  const ToothPhantom one({1, 1, 1}, 0.3);
  EXPECT_FLOAT_EQ(DistanceField(one.grid, one.solid, 1.5).at({0.2F, 0.0F, 3.0F}).distance_mm, 1.5F);
}

}  // namespace
}  // namespace haptics
