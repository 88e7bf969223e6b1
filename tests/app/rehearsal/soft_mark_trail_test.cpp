#include "app/rehearsal/soft_mark_trail.h"

#include <gtest/gtest.h>

#include <random>

#include "render/soft_block.h"

namespace app {
namespace {

using assets::SoftTissue;
using haptics::Tick;

constexpr haptics::BurShape kBall{haptics::ShapeKind::sphere, 1.5, 0.0};

Tick tickOf(const glm::dvec3& bur_P_mm, SoftTissue cuts, SoftTissue pressed = SoftTissue::none, double depth_mm = 0.0) {
  Tick tick;
  tick.dt_s = 1e-3;
  tick.proxy_P.mm = tick.soft.place_P.mm = bur_P_mm;
  tick.soft.bur_cuts = cuts;
  tick.soft.tissue = pressed;
  tick.soft.tissues = static_cast<std::uint8_t>(assets::bitOf(cuts) | assets::bitOf(pressed));
  tick.soft.depth_mm = depth_mm;
  return tick;
}

/// A turning bur that goes along `way` in the given number of ticks.
std::vector<Tick> stroke(const glm::dvec3& from_P_mm, const glm::dvec3& way_mm, int ticks) {
  std::vector<Tick> all;
  for (int n = 0; n <= ticks; ++n) all.push_back(tickOf(from_P_mm + way_mm * (1.0 * n / ticks), SoftTissue::gingiva));
  return all;
}

TEST(SoftMarkTrail, IsTheWayOfATurningBurThroughSoftTissue) {
  SoftMarkTrail trail;
  trail.follow(stroke({1, 2, 3}, {6, 0, 0}, 2000), kBall);
  const render::SoftBlock block = softBlock(trail.marks());
  for (double x = 1.0; x <= 6.5; x += 0.25) {
    EXPECT_LT(cutDistance(block, {x, 2.0, 4.45}), 0.0f) << x;
    EXPECT_GT(cutDistance(block, {x, 2.0, 4.6}), 0.0f) << x;
  }
  EXPECT_LE(trail.marks().cuts.size(), 2u) << "straight on";
}

TEST(SoftMarkTrail, IsNoneWithoutTouch) {
  SoftMarkTrail trail;
  for (int n = 0; n < 3000; ++n) trail.follow(std::vector{tickOf({0.01 * n, 0, 0}, SoftTissue::none)}, kBall);
  EXPECT_TRUE(trail.marks().cuts.empty());
  EXPECT_TRUE(trail.marks().reddened.empty());
}

/// Near enough to be joined, had the bur stayed in.
TEST(SoftMarkTrail, DoesNotCutBetweenTwoPlacesWhereTheBurWasOut) {
  SoftMarkTrail trail;
  trail.follow(std::vector{tickOf({0, 0, 0}, SoftTissue::lip), tickOf({2.75, 0, 0}, SoftTissue::none),
                           tickOf({5.5, 0, 0}, SoftTissue::lip)},
               kBall);
  const render::SoftBlock block = softBlock(trail.marks());
  EXPECT_LT(cutDistance(block, {0, 0, 0}), 0.0f);
  EXPECT_GT(cutDistance(block, {2.75, 0, 0}), 1.0f);
  EXPECT_LT(cutDistance(block, {5.5, 0, 0}), 0.0f);
}

TEST(SoftMarkTrail, DoesNotCutAlongAJumpWithinOneTick) {
  SoftMarkTrail trail;
  trail.follow(std::vector{tickOf({0, 0, 0}, SoftTissue::lip), tickOf({7, 0, 0}, SoftTissue::lip)}, kBall);
  const render::SoftBlock block = softBlock(trail.marks());
  EXPECT_LT(cutDistance(block, {0, 0, 0}), 0.0f);
  EXPECT_GT(cutDistance(block, {3.5, 0, 0}), 1.0f);
  EXPECT_LT(cutDistance(block, {7, 0, 0}), 0.0f);
}

/// Cuts far apart, and among them a small one that lies mostly in a larger one.
TEST(SoftMarkTrail, GivesUpTheCutThatIsBestCoveredByAnother) {
  constexpr haptics::BurShape small_ball{haptics::ShapeKind::sphere, 1.0, 0.0};
  constexpr double apart_mm = 10.0;
  constexpr int places = static_cast<int>(render::kMostSoftCuts), larger = places / 2;
  const auto place = [](int n) { return glm::dvec3(apart_mm * n, 0.0, 0.0); };
  SoftMarkTrail trail;
  const auto touch = [&](const glm::dvec3& at_P_mm, const haptics::BurShape& head) {
    trail.follow(std::vector{tickOf(at_P_mm, SoftTissue::gingiva), tickOf(at_P_mm, SoftTissue::none)}, head);
  };
  const glm::dvec3 beside = place(larger) + glm::dvec3(0.8, 0.0, 0.0), end_of_small = beside + glm::dvec3(0.9, 0, 0);
  for (int n = 0; n + 1 < places; ++n) {
    touch(place(n), kBall);
    if (n == larger) touch(beside, small_ball);
  }
  ASSERT_EQ(trail.marks().cuts.size(), render::kMostSoftCuts);
  EXPECT_LT(cutDistance(softBlock(trail.marks()), end_of_small), 0.0f);
  touch(place(places - 1), kBall);
  EXPECT_EQ(trail.marks().cuts.size(), render::kMostSoftCuts);
  const render::SoftBlock block = softBlock(trail.marks());
  for (int n = 0; n < places; ++n) EXPECT_LT(cutDistance(block, place(n) - glm::dvec3(1.4, 0.0, 0.0)), 0.0f) << n;
  EXPECT_GT(cutDistance(block, end_of_small), 0.0f);
}

TEST(SoftMarkTrail, TakesALongHeadAlongItsAxis) {
  SoftMarkTrail trail;
  trail.follow(std::vector{tickOf({0, 0, 0}, SoftTissue::gingiva)}, {haptics::ShapeKind::capsule, 0.8, 5.0});
  const render::SoftBlock block = softBlock(trail.marks());
  EXPECT_NEAR(cutDistance(block, {0, 0, 3.3}), 0.0f, 1e-5f);
  EXPECT_NEAR(cutDistance(block, {0.8, 0, -2.0}), 0.0f, 1e-5f);
}

TEST(SoftMarkTrail, StaysBoundedAndKeepsMostOfALongWanderingCut) {
  std::mt19937 random(7);
  std::normal_distribution<double> turn(0.0, 0.05);
  SoftMarkTrail trail;
  glm::dvec3 p(0.0), direction(1, 0, 0);
  std::vector<glm::dvec3> way;
  for (int n = 0; n < 20000; ++n) {
    direction = glm::normalize(direction + glm::dvec3(turn(random), turn(random), 0.0) - 0.002 * p);
    p += 0.01 * direction;
    trail.follow(std::vector{tickOf(p, SoftTissue::gingiva)}, kBall);
    way.push_back(p);
  }
  EXPECT_LE(trail.marks().cuts.size(), render::kMostSoftCuts);
  const render::SoftBlock block = softBlock(trail.marks());
  const auto gone = std::ranges::count_if(way, [&](const glm::dvec3& q) { return cutDistance(block, q) < 0.0f; });
  EXPECT_GT(gone, 0.9 * static_cast<double>(way.size()));
}

TEST(SoftMarkTrail, PressedTissueReddensInHalfASecondAndFadesInAboutTwo) {
  SoftMarkTrail trail;
  const auto press = [&](int ticks, double depth_mm) {
    for (int n = 0; n < ticks; ++n)
      trail.follow(std::vector{tickOf({1, 2, 3}, SoftTissue::none, depth_mm > 0.0 ? SoftTissue::lip : SoftTissue::none,
                                      depth_mm)},
                   kBall);
  };
  press(500, 2.0);
  ASSERT_EQ(trail.marks().reddened.size(), 1u);
  const double full = trail.marks().reddened[0].share;
  EXPECT_GT(full, 0.7);
  EXPECT_EQ(trail.marks().reddened[0].place_P.mm, glm::dvec3(1, 2, 3));
  press(800, 0.0);
  EXPECT_NEAR(trail.marks().reddened.at(0).share, full * std::exp(-1.0), 1e-6);
  press(3000, 0.0);
  EXPECT_TRUE(trail.marks().reddened.empty());
  EXPECT_TRUE(trail.marks().cuts.empty());
}

TEST(SoftMarkTrail, IsTheSameHoweverTheTicksAreCutIntoFrames) {
  std::vector<Tick> ticks = stroke({0, 0, 0}, {5, 2, 0}, 400);
  for (int n = 0; n < 300; ++n) ticks.push_back(tickOf({0.02 * n, 8, 0}, SoftTissue::none, SoftTissue::cheek, 1.0));
  SoftMarkTrail whole, apart;
  whole.follow(ticks, kBall);
  for (std::size_t n = 0; n < ticks.size(); n += 17)
    apart.follow(std::span(ticks).subspan(n, std::min<std::size_t>(17, ticks.size() - n)), kBall);
  EXPECT_EQ(softBlock(whole.marks()).cut_way_P, softBlock(apart.marks()).cut_way_P);
  EXPECT_EQ(softBlock(whole.marks()).reddened_P, softBlock(apart.marks()).reddened_P);
  EXPECT_EQ(softBlock(whole.marks()).share, softBlock(apart.marks()).share);
}

}  // namespace
}  // namespace app
