#include "render/volume/smooth_field.h"

#include <gtest/gtest.h>

#include "tests/render/ball_volume.h"

namespace render {
namespace {

using testing::Random;

assets::CtVolume randomVolume(Random& random, glm::ivec3 size) {
  assets::CtVolume ct = testing::ballVolume(testing::smallGrid(size), {});
  for (std::uint8_t& value : ct.solid) value = static_cast<std::uint8_t>(random.between(0.0, 255.9));
  return ct;
}

TEST(SmoothField, EqualsTheTripleSumWrittenOut) {
  Random random(41);
  const assets::CtVolume ct = randomVolume(random, {9, 11, 7});
  const std::vector<std::uint16_t> values = smoothed(ct.grid, ct.solid, {0, 0, 0}, ct.grid.size);
  const int binomial[5] = {1, 4, 6, 4, 1};
  for (int n = 0; n < static_cast<int>(values.size()); ++n) {
    const glm::ivec3 at{n % 9, n / 9 % 11, n / 99};
    std::uint32_t sum = 0;
    for (int t = 0; t < 125; ++t) {
      const glm::ivec3 tap{t % 5, t / 5 % 5, t / 25};
      if (const glm::ivec3 voxel = at + tap - 2; ct.grid.contains(voxel))
        sum += static_cast<std::uint32_t>(binomial[tap.x] * binomial[tap.y] * binomial[tap.z]) *
               ct.solid[ct.grid.index(voxel)];
    }
    ASSERT_EQ(values[static_cast<std::size_t>(n)], (sum * 257) / 4096);
  }
}

TEST(SmoothField, IsTheSameForABoxAsForTheWhole) {
  Random random(42);
  const assets::CtVolume ct = randomVolume(random, {20, 17, 23});
  const std::vector<std::uint16_t> whole = smoothed(ct.grid, ct.solid, {0, 0, 0}, ct.grid.size);
  for (const auto& [first, extent] : {std::pair(glm::ivec3(0, 3, 11), glm::ivec3(12, 12, 12)),
                                      std::pair(glm::ivec3(14, 5, 0), glm::ivec3(6, 12, 5))}) {
    const std::vector<std::uint16_t> box = smoothed(ct.grid, ct.solid, first, extent);
    for (int n = 0; n < static_cast<int>(box.size()); ++n) {
      const glm::ivec3 at = first + glm::ivec3(n % extent.x, n / extent.x % extent.y, n / (extent.x * extent.y));
      ASSERT_EQ(box[static_cast<std::size_t>(n)], whole[ct.grid.index(at)]);
    }
  }
}

TEST(SmoothField, LeavesSolidMatterSolid) {
  const assets::VolumeGrid grid = testing::smallGrid(glm::ivec3(9));
  const std::vector<std::uint8_t> solid(grid.voxelCount(), 255);
  EXPECT_EQ(smoothed(grid, solid, {4, 4, 4}, {1, 1, 1}).front(), 65535);
}

}  // namespace
}  // namespace render
