#include "assets/segment/cell_masks.h"

#include <gtest/gtest.h>

#include "assets/segment/cell_filters.h"
#include "assets/segment/flooding.h"

namespace {

using assets::CellMask;

constexpr glm::ivec3 kSize{17, 15, 13};

template <class Inside>
CellMask maskOf(const Inside& inside) {
  CellMask mask(assets::countIn(kSize), 0);
  assets::forCells(kSize, [&](glm::ivec3 ijk, std::size_t n) { mask[n] = inside(ijk) ? 1 : 0; });
  return mask;
}

bool isIn(glm::ivec3 ijk, glm::ivec3 low, glm::ivec3 high) {
  return glm::all(glm::greaterThanEqual(ijk, low)) && glm::all(glm::lessThanEqual(ijk, high));
}

TEST(CellMasks, PiecesAreWhatHangsTogetherByFaces) {
  const CellMask mask = maskOf([](glm::ivec3 p) {
    return isIn(p, {1, 1, 1}, {3, 3, 3}) || isIn(p, {4, 4, 4}, {8, 8, 8}) || isIn(p, {12, 2, 2}, {12, 2, 2});
  });
  const assets::CellPieces pieces = assets::piecesOfCells(kSize, mask);
  EXPECT_EQ(pieces.cells, (std::vector<std::size_t>{0, 27, 1, 125})) << "a shared corner joins nothing";
  const CellMask largest = assets::largestPiece(kSize, mask);
  EXPECT_EQ(std::ranges::count(largest, 1), 125);
}

TEST(CellMasks, GrowAndShrinkByOneCell) {
  const CellMask cube = maskOf([](glm::ivec3 p) { return isIn(p, {5, 5, 5}, {7, 7, 7}); });
  EXPECT_EQ(std::ranges::count(assets::grownByOne(kSize, cube), 1), 27 + 6 * 9);
  EXPECT_EQ(std::ranges::count(assets::shrunkByOne(kSize, cube), 1), 1);
  const CellMask all(assets::countIn(kSize), 1);
  EXPECT_EQ(std::ranges::count(assets::shrunkByOne(kSize, all), 1), 15 * 13 * 11) << "nothing is beyond the box";
}

TEST(CellMasks, ClosingFillsAGapAndNoMore) {
  const CellMask two = maskOf([](glm::ivec3 p) {
    return isIn(p, {2, 3, 3}, {6, 11, 9}) || isIn(p, {8, 3, 3}, {12, 11, 9});
  });
  const CellMask closed = assets::closedBy(kSize, two, 2.0);
  EXPECT_EQ(closed[assets::indexIn(kSize, {7, 7, 6})], 1);
  EXPECT_EQ(closed[assets::indexIn(kSize, {1, 7, 6})], 0);
  for (std::size_t n = 0; n < two.size(); ++n) EXPECT_GE(closed[n], two[n]);
}

TEST(CellMasks, FillsHolesWithinALayerOnly) {
  const auto ring = [](glm::ivec3 p) {
    return p.z == 4 && isIn(p, {3, 3, 4}, {9, 9, 4}) && !isIn(p, {5, 5, 4}, {7, 7, 4});
  };
  CellMask filled = maskOf(ring);
  assets::fillHolesAcross(kSize, 2, filled);
  EXPECT_EQ(std::ranges::count(filled, 1), 49);
  CellMask open = maskOf(ring);
  assets::fillHolesAcross(kSize, 0, open);
  EXPECT_EQ(std::ranges::count(open, 1), 40) << "across x a ring of one layer is two bars";
}

TEST(Flooding, MeetsAtTheRidge) {
  std::vector<std::uint16_t> level(assets::countIn(kSize));
  assets::forCells(kSize, [&](glm::ivec3 p, std::size_t n) { level[n] = p.x == 9 ? 50 : 10; });
  std::vector<std::uint8_t> label(level.size(), 0);
  label[assets::indexIn(kSize, {1, 7, 6})] = 1;
  label[assets::indexIn(kSize, {11, 7, 6})] = 2;
  const CellMask mask = maskOf([](glm::ivec3 p) { return p.z != 0; });
  assets::flood(kSize, level, mask, label);
  assets::forCells(kSize, [&](glm::ivec3 p, std::size_t n) {
    if (p.z == 0) {
      EXPECT_EQ(label[n], 0);
    } else if (p.x != 9) {
      EXPECT_EQ(label[n], p.x < 9 ? 1 : 2) << p.x << ' ' << p.y << ' ' << p.z;
    }
  });
}

TEST(CellFilters, DerivativesOfAPolynomialAreExact) {
  std::vector<float> values(assets::countIn(kSize));
  assets::forCells(kSize, [&](glm::ivec3 p, std::size_t n) {
    values[n] =
        static_cast<float>(3 * p.x + 4 * p.y) + 0.5F * static_cast<float>(p.z * p.z) + static_cast<float>(p.x * p.z);
  });
  const std::size_t middle = assets::indexIn(kSize, {8, 7, 6});
  EXPECT_NEAR(assets::gradientOfCells(kSize, 0.7, values)[middle], std::sqrt(9.0 * 9.0 + 4.0 * 4.0 + 14.0 * 14.0),
              1e-3);
  EXPECT_NEAR(assets::secondDerivative(kSize, 1.5, values, 2, 2)[middle], 1.0, 1e-3);
  EXPECT_NEAR(assets::secondDerivative(kSize, 1.5, values, 0, 2)[middle], 1.0, 1e-3);
  EXPECT_NEAR(assets::secondDerivative(kSize, 1.5, values, 0, 1)[middle], 0.0, 1e-3);
}

TEST(CellFilters, MeansOfCubesKeepTheirPlace) {
  const assets::VolumeGrid grid{{5, 4, 4}, 0.5, {1, 2, 3}};
  std::vector<std::int16_t> values(grid.voxelCount());
  assets::forVoxels(grid, [&](glm::ivec3 p, std::size_t n) { values[n] = static_cast<std::int16_t>(100 * p.x); });
  const std::vector<float> means = assets::meansOfCubes(grid, values, 2);
  const assets::VolumeGrid cells = assets::meanGrid(grid, 2);
  EXPECT_EQ(cells.size, glm::ivec3(3, 2, 2));
  EXPECT_EQ(cells.origin_P_mm, glm::dvec3(1.25, 2.25, 3.25));
  EXPECT_EQ(means[0], 50.0F);
  EXPECT_EQ(means[2], 400.0F) << "the last cube has one layer";
}

}  // namespace
