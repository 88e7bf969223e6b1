// A round pit in a block of bone is cleaned, and a cave beside it cannot be.

#include "app/procedure/third_molar/cleaning_plan.h"

#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include "app/procedure/debris/follicle.h"
#include "app/procedure/debris/suction_tip.h"
#include "app/procedure/third_molar/cleaning_path.h"

namespace app {
namespace {

constexpr glm::dvec3 kOut{0, 0, 1};
constexpr double kPit_mm = 5.0, kSuction_mm = 1.5, kCurette_mm = 1.2, kFile_mm = 1.0;
constexpr CleaningPlanner::Tips kAll{kSuction_mm, kCurette_mm, kFile_mm, 2.0};

/// Bone up to z = 0; a pit 8 mm deep about the z axis, and a closed cave at x = 9.
struct Bone {
  assets::VolumeGrid grid{glm::ivec3(70, 60, 70), 0.4, glm::dvec3(-12.0, -12.0, -14.0)};
  std::vector<std::uint8_t> jaw;

  Bone() : jaw(grid.voxelCount(), 0) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = grid.centre_P_mm(ijk);
      const bool is_pit = std::hypot(p.x, p.y) < kPit_mm && p.z > -8.0;
      const bool is_cave = glm::length(p - glm::dvec3(9.0, 0.0, -5.0)) < 2.5;
      if (p.z < 0.0 && !is_pit && !is_cave) jaw[v] = 255;
    });
  }
  SocketReach reach() const { return {grid, jaw, {0.0, 0.0, -4.0}, kOut}; }
};

CleaningStep stepOf(const std::optional<OperationStep>& step) { return std::get<CleaningStep>(step->what); }

TEST(SocketReach, KnowsWhereAnInstrumentIsFree) {
  const Bone bone;
  const SocketReach reach = bone.reach();
  EXPECT_TRUE(reach.isFree({0.0, 0.0, -6.0}, kOut, kCurette_mm));
  EXPECT_FALSE(reach.isFree({0.0, 0.0, -7.5}, kOut, kCurette_mm)) << "the floor";
  EXPECT_FALSE(reach.isFree({9.0, 0.0, -5.0}, kOut, kCurette_mm)) << "the roof of the cave";
  EXPECT_FALSE(reach.isFree({-3.0, 0.0, -6.0}, glm::normalize(glm::dvec3(-1.0, 0.0, 1.0)), kCurette_mm)) << "the wall";
  EXPECT_TRUE(reach.isOpen({0.0, 0.0, 2.0}, {0.0, 0.0, -7.0}));
  EXPECT_FALSE(reach.isOpen({0.0, 0.0, -4.0}, {9.0, 0.0, -5.0}));
}

TEST(CleaningPlan, SucksWithinReachOfFewPlacesAndLeavesTheCave) {
  const Bone bone;
  SiteLeft left;
  left.chips_P_mm = {{0, 0, -7}, {1, 0, -7}, {-4, 0, -7}, {4, 0.5, -7}, {9, 0, -5}};
  CleaningPlanner planner(kOut, kOut, kAll);
  const auto step = planner.next(left, bone.grid, bone.jaw);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(step).what, Cleaning::suction);
  EXPECT_LE(stepOf(step).places.size(), 3u);
  std::size_t taken = 0;
  const SocketReach reach = bone.reach();
  for (const glm::dvec3& chip : left.chips_P_mm)
    taken += std::ranges::any_of(stepOf(step).places, [&](const CleaningPlace& place) {
      const glm::dvec3 opening = place.way_P_mm.front() - kSuction_mm * place.shaft_P;
      return glm::distance(opening, chip) < kRinsed_mm && reach.isOpen(opening, chip);
    });
  EXPECT_EQ(taken, 4u);
  for (const CleaningPlace& place : stepOf(step).places)
    EXPECT_TRUE(reach.isFree(place.way_P_mm.front(), place.shaft_P, kSuction_mm));
}

TEST(CleaningPlan, ScrapesAlongTheWallBesideEachBlob) {
  const Bone bone;
  SiteLeft left;
  left.stuck_P_mm = {{4.6, 0, -4}, {0, -4.6, -6}, {0, 0, -7.6}, {9, 0, -3}};
  CleaningPlanner planner(kOut, kOut, kAll);
  const auto step = planner.next(left, bone.grid, bone.jaw);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(step).what, Cleaning::curette);
  ASSERT_EQ(stepOf(step).places.size(), 3u) << "what is in the cave cannot be reached";
  const SocketReach reach = bone.reach();
  for (const CleaningPlace& place : stepOf(step).places) {
    ASSERT_EQ(place.into_P.size(), 1u);
    const glm::dvec3 foot = 0.5 * (place.way_P_mm.front() + place.way_P_mm.back());
    const glm::dvec3 middle = foot - kCurette_mm * place.into_P.front();
    const TipPlace tip = reach.placeAt(middle, place.shaft_P);
    EXPECT_NEAR(tip.wall_mm, kCurette_mm, 0.2) << "it touches";
    EXPECT_GT(glm::dot(place.into_P.front(), -tip.wall_P), 0.9) << "and is pressed on the wall";
    EXPECT_TRUE(std::ranges::any_of(left.stuck_P_mm, [&](const glm::dvec3& blob) {
      return glm::distance(middle, blob) < kCurette_mm + kScrapeReach_mm;
    }));
  }
}

TEST(CleaningPlan, FilesAnEdgeFromThreeSidesWithTheHandleClear) {
  const Bone bone;
  SiteLeft left;
  SharpEdge rim{4.0, 0.3, {}, {}}, speck{0.5, 0.3, {}, {{0, 5, 0}}};
  for (const double angle : {0.2, -0.4, 0.0, 0.4, -0.2})
    rim.points_P_mm.push_back({-kPit_mm * std::cos(angle), kPit_mm * std::sin(angle), -0.1});
  rim.middle_P_mm = rim.points_P_mm[2];
  left.edges = {rim, speck};
  CleaningPlanner planner(kOut, kOut, kAll);
  const auto step = planner.next(left, bone.grid, bone.jaw);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(step).what, Cleaning::file);
  ASSERT_EQ(stepOf(step).places.size(), 1u) << "the speck is not worth it";
  const CleaningPlace place = stepOf(step).places.front();
  const SocketReach reach = bone.reach();
  ASSERT_EQ(place.way_P_mm.size(), rim.points_P_mm.size());
  for (std::size_t n = 1; n < place.way_P_mm.size(); ++n)
    EXPECT_LT(glm::distance(place.way_P_mm[n - 1], place.way_P_mm[n]), 1.5) << "from one to the next along it";
  EXPECT_EQ(place.into_P.size(), 3u);
  for (const glm::dvec3& into : place.into_P) {
    EXPECT_LT(into.z, 0.0);
    for (const glm::dvec3& p : place.way_P_mm)
      EXPECT_TRUE(reach.isFree(p - (kFile_mm + 0.4) * into, place.shaft_P, kFile_mm));
  }
}

TEST(CleaningPlan, NoFileOpensTheJawTowardsTheTongue) {
  const Bone bone;
  SiteLeft left;
  SharpEdge rim{2.0, 0.3, {}, {}};
  for (const double y_mm : {-1.0, -0.5, 0.0, 0.5, 1.0}) rim.points_P_mm.push_back({-kPit_mm, y_mm, -0.1});
  left.edges = {rim};
  const auto filed = [&](double wall_mm) {
    std::vector<glm::dvec3> tongue_P_mm;
    for (double y_mm = -3.0; y_mm <= 3.0; y_mm += 0.2)
      for (double z_mm = -3.0; z_mm <= 0.0; z_mm += 0.2) tongue_P_mm.push_back({-kPit_mm - wall_mm, y_mm, z_mm});
    return CleaningPlanner(kOut, kOut, kAll, tongue_P_mm).next(left, bone.grid, bone.jaw);
  };
  EXPECT_FALSE(filed(0.5)) << "the file would take it away";
  ASSERT_TRUE(filed(3.0));
  EXPECT_EQ(stepOf(filed(3.0)).what, Cleaning::file);
}

TEST(CleaningPlan, GoesFromLooseToScrapedToFiledToStitched) {
  const Bone bone;
  SiteLeft left;
  left.chips_P_mm = {{0, 0, -7}};
  left.stuck_P_mm = {{4.6, 0, -4}};
  left.stitches_P_mm = {{0, 9, 0}, {0, 14, 0}};
  CleaningPlanner planner(kOut, kOut, kAll);
  const auto next = [&] { return planner.next(left, bone.grid, bone.jaw); };
  EXPECT_EQ(next()->words, "suck away what is loose (1 place)");
  left.chips_P_mm.clear();
  EXPECT_EQ(next()->words, "scrape the follicle off (1 place)");
  left.loose_P_mm = std::exchange(left.stuck_P_mm, {});
  EXPECT_EQ(next()->words, "suck away what is loose (1 place)");
  left.loose_P_mm.clear();
  EXPECT_EQ(next()->words, "confirm the stitches (2 places)");
  EXPECT_FALSE(next()) << "the round is over";
}

TEST(CleaningPlan, LeavesOutWhatNoInstrumentIsThereFor) {
  const Bone bone;
  SiteLeft left;
  left.chips_P_mm = {{0, 0, -7}};
  left.stitches_P_mm = {{0, 9, 0}};
  CleaningPlanner::Tips forceps_alone{};
  forceps_alone[3] = 2.0;
  CleaningPlanner planner(kOut, kOut, forceps_alone);
  EXPECT_EQ(stepOf(planner.next(left, bone.grid, bone.jaw)).what, Cleaning::stitch);
  EXPECT_FALSE(CleaningPlanner(kOut, kOut, kAll).next({}, bone.grid, bone.jaw)) << "a clean site needs nothing";
}

TEST(CleaningPath, PressesOnTheWallAndTurnsTheHandleClear) {
  const glm::dvec3 shaft = glm::normalize(glm::dvec3(0.5, 0.0, 1.0));
  const CleaningStep step{Cleaning::curette, {{{{1, 2, 3}, {1, 2, 4}}, shaft, {{-1, 0, 0}}}}, kOut};
  const haptics::LedPath path = cleaningPath({{1, 0, 0, 0}, {0, 0, 40}}, {0, 0, 50}, step, 1.2, {1, 0, 0, 0});
  double least_x_mm = 1e9, handle = -1.0;
  for (double t_s = 0.0; t_s < path.duration_s; t_s += 0.01) {
    const haptics::HandTarget at = path.script(t_s);
    if (glm::distance(at.position_mm, glm::dvec3(1, 2, 3.5)) < 2.2) {
      least_x_mm = std::min(least_x_mm, at.position_mm.x);
      handle = glm::dot(at.rotation * glm::dvec3(0, 0, 1), shaft);
      EXPECT_GT(handle, 0.999);
    }
  }
  EXPECT_GT(handle, 0.0);
  EXPECT_NEAR(least_x_mm, 0.2, 0.05) << "the tip's middle, its surface 2 mm beyond the wall";
  EXPECT_GT(path.patient_mm, 2.0) << "pressed, it does not wait";
}

}  // namespace
}  // namespace app
