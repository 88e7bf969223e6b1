#include "render/volume/occupancy.h"

#include <gtest/gtest.h>

#include "tests/render/ball_volume.h"

namespace render {
namespace {

using testing::brickOf;
using testing::Random;

Occupancy occupancyOf(const BorderedField<std::uint8_t>& solid) { return {solid, 8, assets::kHalfSolid}; }

// Sparse random matter: a few boxes of random value in a volume whose size is no multiple of a brick.
assets::CtVolume randomMatter(Random& random, glm::ivec3 size) {
  const assets::VolumeGrid grid = testing::smallGrid(size);
  assets::CtVolume ct{grid, {}, {}, std::vector<std::uint8_t>(grid.voxelCount(), 0), {}};
  const auto any = [&](int below) { return std::min(static_cast<int>(random.between(0.0, below)), below - 1); };
  for (int box = 0; box < 6; ++box) {
    const glm::ivec3 at{any(size.x), any(size.y), any(size.z)};
    const auto value = static_cast<std::uint8_t>(any(256));
    for (int n = 0; n < 27; ++n)
      if (const glm::ivec3 voxel = at + glm::ivec3(n % 3, n / 3 % 3, n / 9); grid.contains(voxel))
        ct.solid[grid.index(voxel)] = value;
  }
  return ct;
}

std::size_t indexOf(glm::ivec3 brick, glm::ivec3 bricks) {
  return static_cast<std::size_t>((brick.z * bricks.y + brick.y) * bricks.x + brick.x);
}

/// Writes the values of a brick to a field; returns its box.
VoxelBox put(const std::vector<std::uint8_t>& values, glm::ivec3 brick, BorderedField<std::uint8_t>& field) {
  const VoxelBox box = grown({8 * brick, glm::ivec3(8)}, 0, field.layout().size);
  for (int k = 0; k < box.extent.z; ++k)
    for (int j = 0; j < box.extent.y; ++j)
      std::copy_n(&values[static_cast<std::size_t>((k * 8 + j) * 8)], box.extent.x,
                  field.at(box.first + glm::ivec3(0, j, k)));
  return box;
}

/// Whether a sample inside the brick reads a solid voxel, by brute force.
bool touchesSolid(const assets::CtVolume& ct, glm::ivec3 brick) {
  for (int n = 0; n < 1000; ++n)
    if (const glm::ivec3 voxel = 8 * brick + glm::ivec3(n % 10, n / 10 % 10, n / 100) - 1;
        ct.grid.contains(voxel) && ct.solid[ct.grid.index(voxel)] >= assets::kHalfSolid)
      return true;
  return false;
}

TEST(Occupancy, NeverSkipsASampleWithASolidTrilinearFootprint) {
  Random random(11);
  for (int n = 0; n < 20; ++n) {
    const assets::CtVolume ct = randomMatter(random, {37, 43, 50});
    const BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
    const Occupancy occupancy = occupancyOf(solid);
    for (int k = 0; k < ct.grid.size.z; ++k)
      for (int j = 0; j < ct.grid.size.y; ++j)
        for (int i = 0; i < ct.grid.size.x; ++i) {
          if (ct.solid[ct.grid.index({i, j, k})] < assets::kHalfSolid) continue;
          // Samples that read this voxel are less than one voxel away.
          for (int c = 0; c < 8; ++c) {
            const glm::ivec3 touching = glm::ivec3(i, j, k) + glm::ivec3(c & 1, c >> 1 & 1, c >> 2) * 2 - 1;
            const glm::ivec3 brick = glm::clamp(touching, glm::ivec3(0), ct.grid.size - 1) / 8;
            ASSERT_EQ(occupancy.emptiness()[indexOf(brick, occupancy.bricks())], 0);
          }
        }
  }
}

TEST(Occupancy, DistanceIsTheChebyshevDistanceToTheNextOccupiedBrick) {
  Random random(12);
  for (int n = 0; n < 20; ++n) {
    const assets::CtVolume ct = randomMatter(random, {70, 40, 90});
    const BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
    const Occupancy occupancy = occupancyOf(solid);
    const glm::ivec3 bricks = occupancy.bricks();
    std::vector<glm::ivec3> occupied;
    const auto everyBrick = [&](auto&& visit) {
      for (int k = 0; k < bricks.z; ++k)
        for (int j = 0; j < bricks.y; ++j)
          for (int i = 0; i < bricks.x; ++i) visit(glm::ivec3(i, j, k));
    };
    everyBrick([&](glm::ivec3 b) {
      if (touchesSolid(ct, b)) occupied.push_back(b);
    });
    everyBrick([&](glm::ivec3 b) {
      int nearest = Occupancy::kFarthest;
      for (const glm::ivec3& o : occupied) {
        const glm::ivec3 d = glm::abs(o - b);
        nearest = std::min(nearest, std::max({d.x, d.y, d.z}));
      }
      ASSERT_EQ(occupancy.emptiness()[indexOf(b, bricks)], nearest);
    });
  }
}

TEST(Occupancy, BrickUpdatesEqualARebuild) {
  Random random(13);
  for (int n = 0; n < 30; ++n) {
    const assets::CtVolume before = randomMatter(random, {37, 43, 50}), after = randomMatter(random, {37, 43, 50});
    BorderedField<std::uint8_t> solid = testing::borderedSolid(before);
    Occupancy updated = occupancyOf(solid);
    for (int k = 0; k < updated.bricks().z; ++k)
      for (int j = 0; j < updated.bricks().y; ++j)
        for (int i = 0; i < updated.bricks().x; ++i) {
          const std::vector<std::uint8_t> values = brickOf(after, {i, j, k});
          if (values == brickOf(before, {i, j, k})) continue;
          updated.touch(put(values, {i, j, k}, solid));
        }
    updated.rebuildIfStale();
    const BorderedField<std::uint8_t> solid_after = testing::borderedSolid(after);
    const Occupancy rebuilt = occupancyOf(solid_after);
    EXPECT_TRUE(std::ranges::equal(updated.emptiness(), rebuilt.emptiness()));
  }
}

TEST(Occupancy, StaysConservativeWhileStale) {
  Random random(14);
  for (int n = 0; n < 30; ++n) {
    const assets::CtVolume before = randomMatter(random, {37, 43, 50}), after = randomMatter(random, {37, 43, 50});
    BorderedField<std::uint8_t> mixed = testing::borderedSolid(before);
    Occupancy stale = occupancyOf(mixed);
    const glm::ivec3 bricks = stale.bricks();
    for (int step = 0; step < 10; ++step) {
      const glm::ivec3 brick{static_cast<int>(random.between(0, bricks.x - 0.01)),
                             static_cast<int>(random.between(0, bricks.y - 0.01)),
                             static_cast<int>(random.between(0, bricks.z - 0.01))};
      const std::vector<std::uint8_t> values = brickOf(after, brick);
      stale.touch(put(values, brick, mixed));
      stale.refresh();
      const Occupancy exact = occupancyOf(mixed);
      for (std::size_t b = 0; b < exact.emptiness().size(); ++b) ASSERT_LE(stale.emptiness()[b], exact.emptiness()[b]);
    }
  }
}

TEST(Occupancy, KeepsDistancesWhileBricksOnlyEmptyAndUpdatesThemOnRequest) {
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(), {{{0, 0, 0}, 6.0}});
  BorderedField<std::uint8_t> solid = testing::borderedSolid(ct);
  Occupancy occupancy = occupancyOf(solid);
  const std::vector<std::uint8_t> before(occupancy.emptiness().begin(), occupancy.emptiness().end());
  solid = BorderedField<std::uint8_t>(ct.grid.size);  // air
  occupancy.touch({glm::ivec3(0), ct.grid.size});
  EXPECT_FALSE(occupancy.refresh());
  EXPECT_TRUE(std::ranges::equal(occupancy.emptiness(), before));
  EXPECT_TRUE(occupancy.rebuildIfStale());
  EXPECT_TRUE(std::ranges::all_of(occupancy.emptiness(), [](int e) { return e == Occupancy::kFarthest; }));
  EXPECT_FALSE(occupancy.rebuildIfStale());
}

}  // namespace
}  // namespace render
