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

BorderedField<std::uint16_t> smoothed(const assets::CtVolume& ct, const std::vector<VoxelBox>& boxes) {
  BorderedField<std::uint16_t> smooth(ct.grid.size);
  Smoother smoother;
  for (const VoxelBox& box : boxes) smoother.smooth(testing::borderedSolid(ct), box, smooth);
  return smooth;
}

TEST(SmoothField, EqualsTheDirectTripleSum) {
  Random random(41);
  const assets::CtVolume ct = randomVolume(random, {9, 11, 7});
  const BorderedField<std::uint16_t> values = smoothed(ct, {{{0, 0, 0}, ct.grid.size}});
  const int binomial[5] = {1, 4, 6, 4, 1};
  for (int n = 0; n < static_cast<int>(ct.grid.voxelCount()); ++n) {
    const glm::ivec3 at{n % 9, n / 9 % 11, n / 99};
    std::uint32_t sum = 0;
    for (int t = 0; t < 125; ++t) {
      const glm::ivec3 tap{t % 5, t / 5 % 5, t / 25};
      if (const glm::ivec3 voxel = at + tap - 2; ct.grid.contains(voxel))
        sum += static_cast<std::uint32_t>(binomial[tap.x] * binomial[tap.y] * binomial[tap.z]) *
               ct.solid[ct.grid.index(voxel)];
    }
    ASSERT_EQ(*values.at(at), (sum * 257) / 4096);
  }
}

TEST(SmoothField, IsTheSameByBoxesAsForTheWholeVolume) {
  Random random(42);
  const assets::CtVolume ct = randomVolume(random, {20, 17, 23});
  const BorderedField<std::uint16_t> whole = smoothed(ct, {{{0, 0, 0}, ct.grid.size}});
  for (const VoxelBox& box : {VoxelBox{{0, 3, 11}, {12, 12, 12}}, VoxelBox{{14, 5, 0}, {6, 12, 5}}}) {
    const BorderedField<std::uint16_t> part = smoothed(ct, {box});
    for (int n = 0; n < static_cast<int>(box.count()); ++n) {
      const glm::ivec3 e = box.extent, at = box.first + glm::ivec3(n % e.x, n / e.x % e.y, n / (e.x * e.y));
      ASSERT_EQ(*part.at(at), *whole.at(at));
    }
    EXPECT_EQ(*part.at(box.first + box.extent - 1 + glm::ivec3(0, 1, 0)), 0) << "wrote beyond the box";
  }
}

TEST(SmoothField, LeavesSolidMatterSolid) {
  assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(9)), {});
  std::ranges::fill(ct.solid, std::uint8_t{255});
  EXPECT_EQ(*smoothed(ct, {{{4, 4, 4}, {1, 1, 1}}}).at({4, 4, 4}), 65535);
}

}  // namespace
}  // namespace render
