// A bridge of known area between two blocks, at several angles and voxel sizes; mass kept where pieces part.
#include "haptics/body/bridge_search.h"

#include <numbers>
#include <numeric>

#include "assets/ct_volume.h"
#include "haptics/body/piece_split.h"
#include "haptics/body/tooth_survey.h"
#include "tests/haptics/tooth_phantom.h"

namespace haptics {
namespace {

using phantom::bridged;
using phantom::fill;
using phantom::ToothPhantom;

ToothSurvey surveyOf(const ToothPhantom& whole, const ToothPhantom& now) {
  ToothSurvey survey(whole.grid, whole.solid);
  assets::forVoxels(glm::ivec3(0), now.grid.bricks(),
                    [&](glm::ivec3 brick) { survey.update(brick, phantom::brickOf(now, brick)); });
  return survey;
}

ToothFindings findingsOf(ToothSurvey& survey, double cell_mm) {
  ToothFindings found = survey.pieces();
  survey.findBridges(found, cell_mm);
  return found;
}

TEST(Bridge, AreaAndSidesOfARectangleAtAnyAngle) {
  for (const double spacing_mm : {0.15, 0.30})
    for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
      const double angle_rad = degrees * std::numbers::pi / 180.0;
      ToothSurvey survey =
          surveyOf(bridged(spacing_mm, angle_rad, 1.5, 6.0, false), bridged(spacing_mm, angle_rad, 1.5, 6.0, true));
      const ToothFindings found = findingsOf(survey, spacing_mm);
      ASSERT_EQ(found.pieces, 1u);
      ASSERT_EQ(found.held[0].bridges, 1u) << spacing_mm << " mm, " << degrees << " deg";
      const Bridge& bridge = found.held[0].bridge[0];
      const auto text = testing::Message() << spacing_mm << " mm, " << degrees << " deg: " << bridge.area_mm2
                                           << " mm2, " << bridge.width_mm << " x " << bridge.thickness_mm << " mm";
      // A voxel of thickness is allowed; a tenth of it where the faces of the voxels lie along the cut.
      EXPECT_NEAR(bridge.area_mm2, 9.0, degrees == 0.0 ? 0.1 : 6.0 * spacing_mm) << text;
      EXPECT_NEAR(bridge.width_mm, 6.0, 1.5 * spacing_mm) << text;
      EXPECT_NEAR(bridge.thickness_mm, 1.5, 1.5 * spacing_mm) << text;
      const glm::dvec3 w(std::sin(angle_rad), 0.0, std::cos(angle_rad));
      EXPECT_GT(std::abs(glm::dot(bridge.normal, w)), degrees == 0.0 ? 0.999 : 0.7) << text;
      EXPECT_GT(std::abs(bridge.width_axis.y), 0.99) << text;
      EXPECT_LT(glm::length(bridge.centre_mm - w * glm::dot(w, bridge.centre_mm)), 1.2) << text;
    }
}

TEST(Bridge, CoarseCellsGiveTheSameAreaAsFineOnes) {
  for (const double thickness_mm : {1.2, 2.4, 3.6}) {
    ToothSurvey survey =
        surveyOf(bridged(0.15, 0.0, thickness_mm, 6.0, false), bridged(0.15, 0.0, thickness_mm, 6.0, true));
    const double fine_mm2 = findingsOf(survey, 0.15).held[0].bridge[0].area_mm2;
    EXPECT_NEAR(findingsOf(survey, kBridgeCell_mm).held[0].bridge[0].area_mm2 / fine_mm2, 1.0, 0.02);
    EXPECT_NEAR(fine_mm2, 6.0 * thickness_mm, 0.15);
  }
}

TEST(Bridge, ThreePartsHaveTwoBridgesToTheOneInTheMiddle) {
  ToothPhantom whole({130, 40, 40}, 0.2);
  fill(whole, {5, 5, 5}, {125, 35, 35});
  ToothPhantom now = whole;
  for (const int x : {40, 80}) {
    fill(now, {x, 5, 5}, {x + 8, 35, 35}, 0);
    fill(now, {x, 10, 10}, {x + 8, 30, x == 40 ? 15 : 20});
  }
  // One region for both slots: joined by a scratch along the top.
  fill(now, {40, 18, 34}, {88, 22, 35}, 0);
  ToothSurvey survey = surveyOf(whole, now);
  const ToothFindings found = findingsOf(survey, 0.2);
  ASSERT_EQ(found.pieces, 1u);
  const ToothFindings::Held& held = found.held[0];
  ASSERT_EQ(held.parts, 2u);  // the middle lies inside the region
  EXPECT_NEAR(held.bridge[0].area_mm2, 4.0 * 1.0, 0.01);
}

TEST(Bridge, ATCutHasABridgeForEachPartThatHangsOnTheLargest) {
  // A root below, two halves of a crown above, each on a post of its own.
  ToothPhantom whole({80, 40, 80}, 0.2);
  fill(whole, {4, 4, 4}, {76, 36, 76});
  ToothPhantom now = whole;
  fill(now, {4, 4, 36}, {76, 36, 44}, 0);
  fill(now, {36, 4, 36}, {44, 36, 76}, 0);
  fill(now, {12, 15, 36}, {22, 25, 44});
  fill(now, {58, 15, 36}, {68, 30, 44});
  ToothSurvey survey = surveyOf(whole, now);
  survey.pieces();
  const Components& tooth = survey.components();
  const BridgeSearch search(tooth, 0, {VoxelBox(tooth.grid(), {4, 4, 30}, {76, 36, 50}), {}, {}, {}}, 0.2);
  ASSERT_EQ(search.parts().size(), 3u);
  ASSERT_EQ(search.bridges().size(), 2u);
  std::vector<double> areas;
  for (const Bridge& bridge : search.bridges()) {
    EXPECT_EQ(bridge.between[1], 0u);
    EXPECT_LT(bridge.normal.z, -0.999);
    areas.push_back(bridge.area_mm2);
  }
  std::ranges::sort(areas);
  EXPECT_NEAR(areas[0], 4.0, 1e-6);
  EXPECT_NEAR(areas[1], 6.0, 1e-6);
}

TEST(Bridge, AFlatSlotAboveTwoRootsHasOneBridgeToBothOfThem) {
  ToothPhantom whole({80, 40, 80}, 0.2);
  fill(whole, {4, 4, 30}, {76, 36, 76});
  fill(whole, {4, 4, 4}, {36, 36, 30});
  fill(whole, {44, 4, 4}, {76, 36, 30});
  ToothPhantom now = whole;
  fill(now, {4, 4, 34}, {76, 36, 42}, 0);
  fill(now, {30, 4, 34}, {50, 14, 42});
  ToothSurvey survey = surveyOf(whole, now);
  const ToothFindings found = findingsOf(survey, 0.2);
  ASSERT_EQ(found.held[0].parts, 3u);
  ASSERT_EQ(found.held[0].bridges, 1u);
  EXPECT_NEAR(found.held[0].bridge[0].area_mm2, 20 * 10 * 0.04, 1e-6);
  EXPECT_NEAR(found.held[0].bridge[0].width_mm, 4.0, 1e-6);
  EXPECT_NEAR(found.held[0].bridge[0].thickness_mm, 2.0, 1e-6);
}

TEST(Bridge, NothingCutHasNone) {
  const ToothPhantom whole = bridged(0.3, 0.0, 1.5, 6.0, false);
  ToothSurvey survey = surveyOf(whole, whole);
  const ToothFindings found = findingsOf(survey, 0.3);
  EXPECT_EQ(found.pieces, 1u);
  EXPECT_EQ(found.cut_mm3, 0.0);
  EXPECT_EQ(found.held[0].bridges, 0u);
}

TEST(Bridge, AShallowSlotIsNotThrough) {
  ToothPhantom whole({60, 40, 60}, 0.2);
  fill(whole, {4, 4, 4}, {56, 36, 56});
  ToothPhantom now = whole;
  fill(now, {26, 4, 46}, {34, 36, 56}, 0);
  ToothSurvey survey = surveyOf(whole, now);
  const ToothFindings found = findingsOf(survey, 0.2);
  EXPECT_LT(found.held[0].parts, 2u);
  EXPECT_NEAR(found.cut_mm3, 8 * 32 * 10 * 0.008, 1e-9);
}

TEST(PieceSplit, PiecesShareAllBytesExactly) {
  ToothPhantom tooth = bridged(0.3, 0.4, 1.5, 0.0, true);
  const Components components(tooth.grid, tooth.solid);
  ASSERT_EQ(components.pieces().size(), 2u);
  const auto a = bytesOfPiece(components, 0), b = bytesOfPiece(components, 1);
  for (std::size_t v = 0; v < tooth.solid.size(); ++v) {
    ASSERT_TRUE(a[v] == 0 || b[v] == 0);
    ASSERT_EQ(a[v] + b[v], tooth.solid[v]);
  }
}

TEST(PieceSplit, PlansTheNextLargestPieceBlockByBlock) {
  ToothPhantom now({40, 16, 16}, 0.25);
  fill(now, {0, 0, 0}, {20, 16, 16});
  fill(now, {22, 0, 0}, {38, 16, 16}, 200);
  fill(now, {39, 0, 0}, {40, 2, 2});
  const Components components(now.grid, now.solid);
  const SplitPlan plan = partingPlan(components);
  long sum = 0;
  for (std::size_t n = 0; n < plan.blocks.size(); ++n) {
    EXPECT_TRUE(n == 0 || plan.blocks[n - 1].block < plan.blocks[n].block);
    for (const std::uint8_t given : plan.blocks[n].given) {
      EXPECT_TRUE(given == 0 || given == 200);
      sum += given;
    }
  }
  EXPECT_EQ(sum, 200L * 16 * 16 * 16);
  // i 20..39 of 40 in blocks of four: the piece lies in five of ten columns.
  EXPECT_EQ(plan.blocks.size(), 5u * 4 * 4);
  EXPECT_EQ(plan.blocks.front().block, 5u);
}

TEST(PieceSplit, PlansNothingForOnePieceAndChips) {
  ToothPhantom now({40, 16, 16}, 0.25);
  fill(now, {0, 0, 0}, {20, 16, 16});
  fill(now, {22, 0, 0}, {26, 3, 5});
  EXPECT_TRUE(partingPlan(Components(now.grid, now.solid)).blocks.empty());
}

TEST(ToothSurvey, FivePartsAndACrumbAreFivePiecesAndAChip) {
  ToothPhantom whole({120, 20, 20}, 0.2);
  fill(whole, {0, 0, 0}, {120, 20, 20});
  ToothPhantom now = whole;
  for (int n = 1; n < 5; ++n) fill(now, {n * 22, 0, 0}, {n * 22 + 4, 20, 20}, 0);
  fill(now, {111, 0, 0}, {120, 20, 20}, 0);
  fill(now, {115, 0, 0}, {120, 4, 4});
  ToothSurvey survey = surveyOf(whole, now);
  const ToothFindings found = survey.pieces();
  EXPECT_EQ(found.pieces, 5u);
  EXPECT_EQ(found.chips, 1u);
  EXPECT_NEAR(found.chips_mm3, 5 * 4 * 4 * 0.008, 1e-9);
  EXPECT_NEAR(found.piece[0].volume_mm3, 22 * 20 * 20 * 0.008, 1e-9);
}

}  // namespace
}  // namespace haptics
