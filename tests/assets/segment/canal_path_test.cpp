#include "assets/segment/canal_path.h"

#include <gtest/gtest.h>

#include "assets/segment/cheapest_path.h"
#include "assets/segment/tubeness.h"

namespace {

constexpr glm::ivec3 kBlock{24, 20, 20};

std::size_t cell(int i, int j, int k) { return assets::indexIn(kBlock, {i, j, k}); }

/// Grey 1000 with a dark shape in it, smooth at its edge.
template <class Distance>
std::vector<float> darkShape(const Distance& distance) {
  std::vector<float> hu(assets::countIn(kBlock));
  assets::forCells(kBlock, [&](glm::ivec3 p, std::size_t n) {
    hu[n] = 1000.0F - 800.0F * static_cast<float>(std::exp(-0.5 * std::pow(distance(glm::dvec3(p)) / 2.0, 2.0)));
  });
  return hu;
}

TEST(Tubeness, IsHighInATubeAndLowInASheetAndABall) {
  const std::vector<float> tube = assets::darkTubeness(
      kBlock, 2.0, darkShape([](const glm::dvec3& p) { return std::hypot(p.y - 10.0, p.z - 10.0); }));
  const std::vector<float> sheet =
      assets::darkTubeness(kBlock, 2.0, darkShape([](const glm::dvec3& p) { return p.z - 10.0; }));
  const std::vector<float> ball = assets::darkTubeness(
      kBlock, 2.0, darkShape([](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(12.0, 10.0, 10.0)); }));
  const float inside = tube[cell(12, 10, 10)];
  EXPECT_GT(inside, 100.0F);
  EXPECT_LT(tube[cell(12, 16, 10)], 0.05F * inside);
  EXPECT_LT(sheet[cell(12, 10, 10)], 0.05F * inside);
  EXPECT_LT(ball[cell(12, 10, 10)], 0.6F * inside);
}

TEST(CheapestPath, TakesTheCheapWayRoundAndNoBarredOne) {
  std::vector<float> cost(assets::countIn(kBlock), 10.0F);
  // A cheap corridor along two edges, and a wall with one gap.
  for (int i = 2; i <= 20; ++i) cost[cell(i, 2, 10)] = 0.1F;
  for (int j = 2; j <= 17; ++j) cost[cell(20, j, 10)] = 0.1F;
  const std::vector<std::size_t> from{cell(2, 2, 10)}, to{cell(20, 17, 10)};
  const std::vector<std::size_t> path = assets::cheapestPath(kBlock, cost, from, to);
  ASSERT_FALSE(path.empty());
  EXPECT_EQ(path.front(), from[0]);
  EXPECT_EQ(path.back(), to[0]);
  for (const std::size_t at : path) EXPECT_EQ(cost[at], 0.1F);
  assets::forCells(kBlock, [&](glm::ivec3 p, std::size_t n) {
    if (p.x == 12) cost[n] = 0.0F;
  });
  EXPECT_TRUE(assets::cheapestPath(kBlock, cost, from, to).empty());
  cost[cell(12, 15, 4)] = 10.0F;
  const std::vector<std::size_t> through = assets::cheapestPath(kBlock, cost, from, to);
  EXPECT_TRUE(std::ranges::find(through, cell(12, 15, 4)) != through.end());
}

}  // namespace
