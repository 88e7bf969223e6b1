// A bite on articulating paper against closed forms (reference/sisters 5.4, 7): a cusp of radius R on a plane is marked
// over pi (2 R t - t^2) by paper of thickness t.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "app/procedure/preparation/bite.h"
#include "tests/app/procedure/preparation/cusps.h"

namespace app::round_tooth {
namespace {

TEST(Bite, ACuspOnAPlaneIsMarkedOverItsCap) {
  // The numbers of the reference, to check the formula itself.
  const std::vector<std::pair<double, double>> known{{8, 0.1003}, {40, 0.4976}, {100, 1.225}, {200, 2.388}};
  for (const glm::dvec2& place : {glm::dvec2(0.0), glm::dvec2(1.313, -0.777)}) {
    const OcclusalRaster heights = heightsOf(cusps({{place, kPlane_mm + 0.013}}));
    for (const auto& [paper_um, area_mm2] : known) {
      const double paper_mm = 0.001 * paper_um;
      EXPECT_NEAR(cap_mm2(paper_mm), area_mm2, 0.0006);
      const Bite bite = biteOn(heights, plane(kPlane_mm), paper_mm);
      ASSERT_EQ(bite.contacts.size(), 1u) << paper_um;
      EXPECT_NEAR(bite.contacts[0].area_mm2, cap_mm2(paper_mm), 0.02 * cap_mm2(paper_mm)) << paper_um << " µm";
      EXPECT_NEAR(bite.open_mm, 0.013, 0.002);
      ASSERT_TRUE(bite.first_mm);
      EXPECT_LT(glm::distance(*bite.first_mm, place), 0.08);
      EXPECT_NEAR(bite.contacts[0].gap_mm, 0.0, 0.0003);
    }
  }
}

// Wherever its top lies among the voxels: a foil's mark is that of a gap of 8 µm, of which a tenth is 1.25 %.
TEST(Bite, TheMarkOfAFoilIsTrueWhereverTheCuspStands) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  double mean = 0.0, worst = 0.0;
  constexpr int kCusps = 12;
  for (int n = 0; n < kCusps; ++n) {
    const glm::dvec2 place(2.0 * any(random), 2.0 * any(random));
    const OcclusalRaster heights = heightsOf(cusps({{place, kPlane_mm + 0.05 * any(random)}}));
    const Bite bite = biteOn(heights, plane(6.5), 0.008);
    ASSERT_EQ(bite.contacts.size(), 1u);
    const double off = bite.contacts[0].area_mm2 / cap_mm2(0.008) - 1.0;
    mean += off / kCusps, worst = std::max(worst, std::abs(off));
  }
  EXPECT_LT(std::abs(mean), 0.01);
  EXPECT_LT(worst, 0.02);
}

TEST(Bite, AHighSpotAloneIsMarkedUntilThePaperIsThickerThanItIsHigh) {
  const double high_mm = 0.1;
  const OcclusalRaster heights =
      heightsOf(cusps({{{-2.4, 0.3}, kPlane_mm + high_mm}, {{2.4, 0.5}, kPlane_mm}, {{0.2, -2.2}, kPlane_mm}}));
  for (const double paper_um : {8.0, 40.0, 90.0}) {
    const Bite bite = biteOn(heights, plane(kPlane_mm), 0.001 * paper_um);
    ASSERT_EQ(bite.contacts.size(), 1u) << "others dark with " << paper_um;
    EXPECT_NEAR(bite.open_mm, high_mm, 0.002);
    EXPECT_LT(glm::distance(*bite.first_mm, {-2.4, 0.3}), 0.08);
    EXPECT_NEAR(bite.contacts[0].area_mm2, cap_mm2(0.001 * paper_um), 0.02 * cap_mm2(0.001 * paper_um));
  }
  const Bite thick = biteOn(heights, plane(kPlane_mm), 0.2);
  ASSERT_EQ(thick.contacts.size(), 3u);
  EXPECT_NEAR(thick.contacts[1].area_mm2, cap_mm2(0.1), 0.03 * cap_mm2(0.1));
  EXPECT_NEAR(thick.contacts[1].gap_mm, high_mm, 0.001);
}

TEST(Bite, ATwinThatCountsCellsAgrees) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int n = 0; n < 4; ++n) {
    const OcclusalRaster heights = heightsOf(cusps({{{2.4 * any(random), 2.4 * any(random)}, 6.9 + 0.1 * any(random)},
                                                    {{2.4 * any(random), 2.4 * any(random)}, 6.9, 1.5}}));
    const Bite bite = biteOn(heights, plane(6.5), 0.15);
    double marked_mm2 = 0.0, highest_mm = 0.0;
    for (int y = 0; y < OcclusalRaster::kSide; ++y)
      for (int x = 0; x < OcclusalRaster::kSide; ++x)
        if (heights.has(x, y)) highest_mm = std::max(highest_mm, static_cast<double>(heights.at(x, y)));
    for (int y = 0; y < OcclusalRaster::kSide; ++y)
      for (int x = 0; x < OcclusalRaster::kSide; ++x)
        if (heights.has(x, y) && highest_mm - static_cast<double>(heights.at(x, y)) <= 0.15)
          marked_mm2 += OcclusalRaster::kStep_mm * OcclusalRaster::kStep_mm;
    EXPECT_NEAR(bite.area_mm2(), marked_mm2, 0.03 * marked_mm2 + 0.01);
    EXPECT_NEAR(bite.open_mm, highest_mm - 6.5, 0.0005);
  }
}

TEST(Bite, AToothThatWasLoweredIsFreeByAsMuch) {
  const Bite bite = biteOn(heightsOf(stump(4.0, 6.0, 5.5)), plane(kPlane_mm), 0.2);
  EXPECT_TRUE(bite.contacts.empty());
  EXPECT_FALSE(bite.first_mm);
  EXPECT_EQ(bite.open_mm, 0.0) << "the rest of the teeth stop the jaws";
  EXPECT_NEAR(bite.clearance_mm, 1.5, 0.002);
  EXPECT_EQ(biteLine(bite), "bite: free by 1.50 mm");
  EXPECT_EQ(biteLine(biteOn(heightsOf(stump(4.0, 6.0, 5.5)), {}, 0.04)), "bite: nothing opposes it");
}

// Of teeth with three to five cusps: it rests on the intact tooth at three places around the middle, and goes into it
// nowhere.
TEST(Bite, AMadeAntagonistRestsOnTheIntactToothAsATripod) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int count = 3; count <= 5; ++count) {
    std::vector<Cusp> all;
    for (int n = 0; n < count; ++n) {
      const double turn = 2.0 * std::numbers::pi * (n + 0.2 * any(random)) / count;
      all.push_back({{2.6 * std::cos(turn), 2.6 * std::sin(turn)}, 6.0 + 0.3 * any(random), 1.8 + 0.2 * any(random)});
    }
    const OcclusalRaster intact = heightsOf(cusps(all));
    const Antagonist made = madeAntagonist(intact);
    EXPECT_TRUE(made.is_made);
    // Of thinner paper some marks are less than is told.
    const Bite bite = biteOn(intact, made, 0.04);
    EXPECT_LT(bite.open_mm, 1e-5);
    EXPECT_LT(bite.clearance_mm, 1e-4);
    ASSERT_GE(bite.contacts.size(), 3u);
    std::vector<double> turns;
    for (const BiteContact& contact : bite.contacts)
      turns.push_back(std::atan2(contact.place_mm.y, contact.place_mm.x));
    std::ranges::sort(turns);
    turns.push_back(turns.front() + 2.0 * std::numbers::pi);
    for (std::size_t n = 0; n + 1 < turns.size(); ++n)
      EXPECT_LT(turns[n + 1] - turns[n], std::numbers::pi + 0.3) << "the middle lies among them";
    // What is laid on a cusp keeps the jaws open by as much, less what it was free by.
    all[0].top_mm += 0.3;
    const Bite high = biteOn(heightsOf(cusps(all)), made, 0.04);
    EXPECT_GT(high.open_mm, 0.1);
    EXPECT_LT(high.open_mm, 0.301);
    ASSERT_GE(high.contacts.size(), 1u);
    for (const BiteContact& contact : high.contacts)
      EXPECT_LT(glm::distance(contact.place_mm, all[0].place_mm), 1.6) << "there alone";
  }
}

TEST(Bite, MarksLieOnTheSurfaceOfTheToothAsItIs) {
  const BoxBytes made = bittenScene().made(cusps({{{0.5, 0.5}, kPlane_mm}}));
  const OcclusalRaster heights = occlusalHeights(bittenScene().crown, made);
  const Bite bite = biteOn(heights, plane(kPlane_mm), 0.04);
  const PaintSpots spots = biteSpots(bittenScene().crown, made, heights, bite);
  ASSERT_GT(spots.size(), 100u);
  const double radius_mm = std::sqrt(cap_mm2(0.04) / std::numbers::pi);
  for (const PaintSpot& spot : spots) {
    const auto v = static_cast<int>(spot.voxel);
    const glm::ivec3 size = made.grid().size;
    const glm::dvec3 p =
        bittenScene().frame.local(made.grid().centre_P_mm({v % size.x, v / size.x % size.y, v / size.x / size.y}));
    EXPECT_LT(glm::distance(glm::dvec2(p), {0.5, 0.5}), radius_mm + 0.05);
    EXPECT_NEAR(p.z, kPlane_mm, 0.2);
    EXPECT_EQ(spot.texel >> 24, 255u);
  }
}

TEST(Bite, PlacesHaveNamesOfATooth) {
  EXPECT_EQ(placeName({0.2, -0.4}), "middle");
  EXPECT_EQ(placeName({2.0, 0.5}), "mesial");
  EXPECT_EQ(placeName({-2.0, 2.0}), "distobuccal");
  EXPECT_EQ(placeName({0.5, -2.0}), "lingual");
}

}  // namespace
}  // namespace app::round_tooth
