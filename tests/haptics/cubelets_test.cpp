#include "haptics/bone/cubelets.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

/// Sums of a block, voxel by voxel.
void expectSumsOfItsVoxels(const SolidField& field, glm::ivec3 block) {
  std::uint32_t weight = 0, x = 0, y = 0, z = 0, grey = 0;
  for (int n = 0; n < kBlockVoxels; ++n) {
    const glm::ivec3 local(n & 3, n >> 2 & 3, n >> 4), ijk = block * kBlockEdge + local;
    const std::uint32_t w = field.grid.contains(ijk) ? field.solidAt(ijk) : 0u;
    weight += w, grey += w * (255 - w);
    x += w * static_cast<std::uint32_t>(local.x), y += w * static_cast<std::uint32_t>(local.y);
    z += w * static_cast<std::uint32_t>(local.z);
  }
  const std::size_t at = field.slotAt(block);
  EXPECT_EQ(field.weight[at], weight);
  EXPECT_EQ(field.weight_x[at], x);
  EXPECT_EQ(field.weight_y[at], y);
  EXPECT_EQ(field.weight_z[at], z);
  EXPECT_EQ(field.grey[at], grey);
}

Phantom randomBone(glm::ivec3 size) {
  std::mt19937 random(3);
  Phantom phantom;
  phantom.grid = {size, 0.2, glm::dvec3(0.0)};
  phantom.solid.resize(phantom.grid.voxelCount());
  for (auto& solid : phantom.solid) solid = static_cast<std::uint8_t>(random() % 256);
  return phantom;
}

TEST(Cubelets, HoldEveryVoxelAndItsLabelAndTheSumsOfEachBlock) {
  const Phantom phantom = randomBone({9, 13, 6});  // no side is whole blocks
  std::vector<std::uint8_t> label(phantom.solid.size());
  for (std::size_t i = 0; i < label.size(); ++i) label[i] = static_cast<std::uint8_t>(i % 10);
  const Cubelets cubelets(phantom.grid, phantom.solid, label);
  const SolidField field = cubelets.field();
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 13; ++j)
      for (int i = 0; i < 9; ++i) {
        ASSERT_EQ(field.solidAt({i, j, k}), phantom.solid[phantom.grid.index({i, j, k})]);
        ASSERT_EQ(field.labelAt({i, j, k}), label[phantom.grid.index({i, j, k})]);
      }
  for (int z = 0; z < field.blocks.z; ++z)
    for (int y = 0; y < field.blocks.y; ++y)
      for (int x = 0; x < field.blocks.x; ++x) expectSumsOfItsVoxels(field, {x, y, z});
}

TEST(Cubelets, KnowABlockOfOneLabelFromAMixedOne) {
  const Phantom phantom = block(0.8, 0.2);  // 8 voxels an edge
  std::vector<std::uint8_t> label(phantom.solid.size(), 4);
  label[phantom.grid.index({5, 1, 2})] = 1;
  const Cubelets cubelets(phantom.grid, phantom.solid, label);
  const SolidField field = cubelets.field();
  EXPECT_EQ(field.only_label[field.slotAt({0, 0, 0})], 4);
  EXPECT_EQ(field.only_label[field.slotAt({1, 0, 0})], kMixedLabels);
}

TEST(Cubelets, KeepTheSumsRightWhenABlockChanges) {
  const Phantom phantom = randomBone({8, 8, 8});
  Cubelets cubelets(phantom.grid, phantom.solid, {});
  std::array<std::uint8_t, kBlockVoxels> changed{};
  for (std::size_t n = 0; n < changed.size(); ++n) changed[n] = static_cast<std::uint8_t>(n * 3);
  cubelets.setBlock(cubelets.field().blockAt({1, 0, 1}), changed);
  expectSumsOfItsVoxels(cubelets.field(), {1, 0, 1});
  expectSumsOfItsVoxels(cubelets.field(), {0, 0, 0});
  EXPECT_EQ(cubelets.field().solidAt({4 + 1, 2, 4 + 3}), changed[3 * 16 + 2 * 4 + 1]);
}

}  // namespace
}  // namespace haptics
