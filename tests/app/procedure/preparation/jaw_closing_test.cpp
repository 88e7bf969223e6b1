// How jaws close on a tooth, against closed forms: a plane that turns about a hinge onto a ball, a plane that tips onto
// three cusps.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <glm/gtc/quaternion.hpp>

#include "app/procedure/preparation/bite.h"
#include "app/procedure/preparation/jaw_closing.h"
#include "app/procedure/preparation/resting_plane.h"
#include "tests/app/procedure/preparation/cusps.h"

namespace app::round_tooth {
namespace {

/// Behind the tooth and over its bite; the jaws open about the way to the tongue.
Antagonist hinged(double height_mm, const glm::dvec2& behind_and_over_mm) {
  Antagonist flat = plane(height_mm);
  flat.closing = assets::Closing::hinge;
  flat.hinge_mm = {-behind_and_over_mm.x, 0.0, height_mm + behind_and_over_mm.y};
  flat.opens = {0.0, -1.0, 0.0};
  return flat;
}

// The plane z = height turned by a about the hinge H has the normal n = (-sin a, 0, cos a) and n (p - H) = -over. It
// touches a ball of middle C and radius R where n (C - H) + R = -over.
TEST(JawClosing, APlaneTurnsAboutTheHingeOntoACusp) {
  for (const double high_mm : {0.02, 0.3, 1.0}) {
    const glm::dvec2 place(1.313, -0.777);
    const OcclusalRaster heights = heightsOf(cusps({{place, kPlane_mm + high_mm}}));
    for (const glm::dvec2& hinge : {glm::dvec2(55.0, 32.0), glm::dvec2(80.0, 0.0), glm::dvec2(30.0, 20.0)}) {
      const Bite bite = biteOn(heights, hinged(kPlane_mm, hinge), 0.04);
      const glm::dvec2 arm(place.x + hinge.x, high_mm - kCusp_mm - hinge.y);
      // arm.y cos a - arm.x sin a = -over - R.
      const double angle = std::atan2(arm.y, arm.x) + std::asin((hinge.y + kCusp_mm) / glm::length(arm));
      ASSERT_GT(angle, 0.0);
      ASSERT_TRUE(bite.first_mm);
      EXPECT_NEAR(bite.first_mm->x, place.x - kCusp_mm * std::sin(angle), 0.002);
      EXPECT_NEAR(bite.first_mm->y, place.y, 0.002);
      EXPECT_EQ(bite.closing, assets::Closing::hinge);
      for (const double x : {-2.0, 0.0, 3.0}) {
        const glm::dvec2 beside(x, 0.5);
        const double over_mm = kPlane_mm + hinge.y + ((x + hinge.x) * std::sin(angle) - hinge.y) / std::cos(angle);
        EXPECT_NEAR(static_cast<double>(bite.gap_mm.at(beside)), over_mm - static_cast<double>(heights.at(beside)),
                    0.0015)
            << x << " of " << hinge.x << ", " << high_mm;
      }
      ASSERT_EQ(bite.contacts.size(), 1u);
      // As seen along the axis.
      EXPECT_NEAR(bite.contacts[0].area_mm2, cap_mm2(0.04), 0.03 * cap_mm2(0.04));
    }
  }
}

TEST(JawClosing, AHighSpotIsMetFirstAndLiftsTheRestByTheirLevers) {
  const double high_mm = 0.12;
  const std::vector<Cusp> all{{{-2.4, 0.3}, kPlane_mm + high_mm}, {{2.4, 0.5}, kPlane_mm}, {{0.2, -2.2}, kPlane_mm}};
  const OcclusalRaster heights = heightsOf(cusps(all));
  const Bite bite = biteOn(heights, hinged(kPlane_mm, {55.0, 0.0}), 0.008);
  ASSERT_EQ(bite.contacts.size(), 1u);
  EXPECT_LT(glm::distance(*bite.first_mm, all[0].place_mm), 0.02);
  EXPECT_NEAR(bite.open_mm, high_mm, 0.002);
  for (const Cusp& one : {all[1], all[2]})
    EXPECT_NEAR(static_cast<double>(bite.gap_mm.at(one.place_mm)),
                high_mm * (55.0 + one.place_mm.x) / (55.0 + all[0].place_mm.x), 0.002);
  // A tooth that is free stays free: the rest of the teeth meet.
  const Bite free = biteOn(heights, hinged(kPlane_mm + 0.5, {55.0, 30.0}), 0.04);
  EXPECT_EQ(free.open_mm, 0.0);
  EXPECT_NEAR(free.clearance_mm, 0.5 - high_mm, 0.002);
}

TEST(JawClosing, APlaneComesToRestOnThreeUnequalCusps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int n = 0; n < 4; ++n) {
    std::vector<Cusp> all;
    for (int k = 0; k < 3; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k + 0.15 * any(random)) / 3.0;
      all.push_back({{2.6 * std::cos(turn), 2.6 * std::sin(turn)}, kPlane_mm + 0.08 * any(random), 1.5});
    }
    const OcclusalRaster heights = heightsOf(cusps(all));
    Antagonist flat = plane(6.8);
    flat.closing = assets::Closing::balance;
    const Bite bite = biteOn(heights, flat, 0.02);
    EXPECT_TRUE(bite.is_balanced);
    ASSERT_EQ(bite.contacts.size(), 3u);
    const auto highest = std::ranges::max_element(all, {}, &Cusp::top_mm);
    EXPECT_NEAR(bite.open_mm, highest->top_mm - 6.8, 0.002);
    EXPECT_LT(glm::distance(*bite.first_mm, highest->place_mm), 0.02) << "the highest is met first";
    for (const Cusp& one : all) {
      const double rests_mm = static_cast<double>(bite.gap_mm.at(one.place_mm) + heights.at(one.place_mm));
      EXPECT_NEAR(rests_mm, one.top_mm, 0.002) << "the plane goes through its tip";
    }
  }
}

TEST(JawClosing, WhatIsHeldOnOneSideAloneWouldTip) {
  const OcclusalRaster heights = heightsOf(cusps({{{2.0, 0.0}, kPlane_mm}, {{-2.5, 0.5}, kPlane_mm}}));
  Antagonist half = plane(6.9);
  half.closing = assets::Closing::balance;
  for (int y = 0; y < OcclusalRaster::kSide; ++y)
    for (int x = 0; x < OcclusalRaster::kSide; ++x)
      if (OcclusalRaster::place_mm(x, y).x < 0.5) half.height_mm.at(x, y) = OcclusalRaster::kNone;
  const Bite bite = biteOn(heights, half, 0.04);
  EXPECT_FALSE(bite.is_balanced);
  EXPECT_NEAR(bite.open_mm, 0.1, 0.002);
  EXPECT_EQ(bite.contacts.size(), 1u);
  EXPECT_EQ(biteRows(bite).back().means, "nothing holds it on three contacts");
}

TEST(JawClosing, ASurfaceIsMovedAsOneBody) {
  // A ball's lower half, turned and shifted, is the ball at its new place.
  const glm::dvec3 middle(0.4, -0.3, 12.0);
  const double radius_mm = 5.0;
  OcclusalRaster ball, all;
  for (int y = 0; y < OcclusalRaster::kSide; ++y)
    for (int x = 0; x < OcclusalRaster::kSide; ++x) {
      const glm::dvec2 off = OcclusalRaster::place_mm(x, y) - glm::dvec2(middle);
      if (glm::length(off) < 4.0)
        ball.at(x, y) = static_cast<float>(middle.z - std::sqrt(radius_mm * radius_mm - glm::dot(off, off)));
      all.at(x, y) = 8.0F;
    }
  const JawMotion motion{glm::mat3_cast(glm::angleAxis(0.08, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)))),
                         {0.05, -0.2, 0.3}};
  const glm::dvec3 there = motion.at(middle);
  const OcclusalRaster moved = movedOver(all, ball, motion);
  int count = 0;
  for (int y = 0; y < OcclusalRaster::kSide; ++y)
    for (int x = 0; x < OcclusalRaster::kSide; ++x) {
      const glm::dvec2 off = OcclusalRaster::place_mm(x, y) - glm::dvec2(there);
      if (glm::length(off) > 3.0) continue;
      ++count;
      EXPECT_NEAR(static_cast<double>(moved.at(x, y)), there.z - std::sqrt(radius_mm * radius_mm - glm::dot(off, off)),
                  0.0003);
    }
  EXPECT_GT(count, 9000);
}

// Over all triples.
TEST(RestingPlane, ATwinThatTriesAllTriplesAgrees) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int n = 0; n < 40; ++n) {
    std::vector<Support> all;
    for (int k = 0; k < 12; ++k) all.push_back({{4.0 * any(random), 4.0 * any(random)}, any(random)});
    const glm::dvec2 load(0.5 * any(random), 0.5 * any(random));
    double lowest_mm = 1e9;
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a + 1; b < all.size(); ++b)
        for (std::size_t c = b + 1; c < all.size(); ++c) {
          const glm::dmat3 rows(glm::dvec3(all[a].place_mm, 1.0), glm::dvec3(all[b].place_mm, 1.0),
                                glm::dvec3(all[c].place_mm, 1.0));
          const glm::dvec3 one = glm::dvec3(all[a].height_mm, all[b].height_mm, all[c].height_mm) * glm::inverse(rows);
          const bool over_all = std::ranges::all_of(
              all, [&](const Support& s) { return glm::dot(one, glm::dvec3(s.place_mm, 1.0)) > s.height_mm - 1e-9; });
          // The lowest under the load of those that lie over all is where it rests.
          if (over_all) lowest_mm = std::min(lowest_mm, glm::dot(one, glm::dvec3(load, 1.0)));
        }
    const auto plane = restingPlane(all, load);
    ASSERT_EQ(plane.has_value(), lowest_mm < 1e8);
    EXPECT_NEAR(plane ? plane->at_mm(load) : lowest_mm, lowest_mm, 1e-6);
  }
  EXPECT_FALSE(restingPlane({{{1.0, 0.0}, 0.0}, {{2.0, 1.0}, 0.0}, {{2.0, -1.0}, 0.0}}, {0.0, 0.0}));
}

}  // namespace
}  // namespace app::round_tooth
