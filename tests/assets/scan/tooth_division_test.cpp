#include "assets/scan/tooth_division.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "assets/tissue.h"

namespace assets {
namespace {

constexpr std::uint8_t kBone = 1, kEnamel = 4, kDentine = 5, kLigament = 8;

/// A labelled volume with a tooth.
struct Scan {
  VolumeGrid grid;
  std::vector<std::uint8_t> solid, label, is_tooth;

  explicit Scan(const VolumeGrid& on)
      : grid(on), solid(on.voxelCount()), label(on.voxelCount()), is_tooth(on.voxelCount()) {}
  ToothDivision divided() const { return divideByTooth(grid, solid, label, is_tooth); }
};

/// Solid bone with a box of dentine from 11 to before 19 along each axis.
Scan boxInBone() {
  Scan scan({{30, 29, 27}, 0.25, {-3.0, 1.0, 2.0}});
  forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const bool inside =
        glm::all(glm::greaterThanEqual(ijk, glm::ivec3(11))) && glm::all(glm::lessThan(ijk, glm::ivec3(19)));
    scan.solid[v] = 255;
    scan.label[v] = inside ? kDentine : kBone;
    scan.is_tooth[v] = inside ? 1 : 0;
  });
  return scan;
}

/// Any bytes at all.
Scan randomScan(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> edge(1, 21), byte(0, 255), label(0, 12);
  Scan scan({{edge(random), edge(random), edge(random)}, 0.3, {0.0, 0.0, 0.0}});
  for (std::size_t v = 0; v < scan.solid.size(); ++v) {
    scan.solid[v] = static_cast<std::uint8_t>(byte(random));
    scan.label[v] = static_cast<std::uint8_t>(label(random));
    scan.is_tooth[v] = byte(random) < 40 ? 1 : 0;
  }
  return scan;
}

/// The tooth's voxel under a voxel of the jaw's grid; 0 outside its box.
int toothAt(const ToothDivision& divided, glm::ivec3 ijk, const std::vector<std::uint8_t>& values) {
  const glm::ivec3 own = ijk - divided.first_brick * kBrickVoxels;
  return divided.tooth.grid.contains(own) ? values[divided.tooth.grid.index(own)] : 0;
}

TEST(ToothDivision, PartsAddUpToTheWholeInEveryVoxel) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Scan scan = randomScan(seed);
    const ToothDivision divided = scan.divided();
    forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
      ASSERT_EQ(divided.jaw.solid[v] + toothAt(divided, ijk, divided.tooth.solid), scan.solid[v]) << seed;
    });
  }
}

TEST(ToothDivision, ToothLiesInWholeBricksOfTheGrid) {
  const ToothDivision divided = boxInBone().divided();
  EXPECT_EQ(divided.first_brick, glm::ivec3(1));
  EXPECT_EQ(divided.tooth.grid.size % kBrickVoxels, glm::ivec3(0));
  EXPECT_EQ(divided.tooth.grid.origin_P_mm, boxInBone().grid.centre_P_mm(glm::ivec3(8)));
}

TEST(ToothDivision, BothFadeAcrossTheirBorder) {
  // Across the middle of a face the binomial weights are 1/4 and 3/4 on either side of it.
  const ToothDivision divided = boxInBone().divided();
  const auto tooth = [&](int i) { return toothAt(divided, {i, 15, 15}, divided.tooth.solid); };
  EXPECT_EQ(tooth(9), 0);
  EXPECT_EQ(tooth(10), 64);
  EXPECT_EQ(tooth(11), 191);
  EXPECT_EQ(tooth(12), 255);
}

TEST(ToothDivision, EachSideOfTheBorderHasItsOwnLabel) {
  const ToothDivision divided = boxInBone().divided();
  EXPECT_EQ(toothAt(divided, {10, 15, 15}, divided.tooth.label), kDentine);
  EXPECT_EQ(divided.jaw.label[boxInBone().grid.index({11, 15, 15})], kBone);
  EXPECT_EQ(divided.jaw.label[boxInBone().grid.index({15, 15, 15})], kDentine) << "no bone is near";
}

TEST(ToothDivision, ToothBehindALigamentKeepsItsFace) {
  Scan scan = boxInBone();
  forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::ivec3 out = glm::max(glm::ivec3(11) - ijk, ijk - 18);
    if (std::max({out.x, out.y, out.z}) != 1) return;
    scan.label[v] = kLigament;
    scan.solid[v] = 0;
  });
  const ToothDivision divided = scan.divided();
  EXPECT_EQ(toothAt(divided, {11, 15, 15}, divided.tooth.solid), 255);
  EXPECT_EQ(toothAt(divided, {10, 15, 15}, divided.tooth.solid), 0);
}

TEST(ToothDivision, WithoutToothTheJawIsTheVolume) {
  Scan scan = boxInBone();
  std::ranges::fill(scan.is_tooth, std::uint8_t{0});
  for (const ToothDivision& divided :
       {scan.divided(), divideByTooth(scan.grid, scan.solid, scan.label, std::span<const std::uint8_t>{})}) {
    EXPECT_EQ(divided.jaw.solid, scan.solid);
    EXPECT_EQ(divided.jaw.label, scan.label);
    EXPECT_TRUE(divided.tooth.solid.empty());
  }
}

TEST(ToothDivision, OneVoxelIsATooth) {
  Scan scan({{3, 3, 3}, 0.3, {0.0, 0.0, 0.0}});
  const std::size_t middle = scan.grid.index({1, 1, 1});
  scan.solid[middle] = 200, scan.label[middle] = kEnamel, scan.is_tooth[middle] = 1;
  const ToothDivision divided = scan.divided();
  EXPECT_EQ(divided.tooth.grid.size, glm::ivec3(8));
  EXPECT_EQ(toothAt(divided, {1, 1, 1}, divided.tooth.solid), 200);
  EXPECT_EQ(toothAt(divided, {1, 1, 1}, divided.tooth.label), kEnamel);
}

}  // namespace
}  // namespace assets
