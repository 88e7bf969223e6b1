#include "app/case/handpiece_direction.h"

#include <gtest/gtest.h>

#include "app/case/gutter_plan.h"
#include "tests/app/case/block_with_molar.h"

namespace app {
namespace {

haptics::Tool roundBur() {
  haptics::Tool tool;
  tool.head.radius_mm = kUsualBurRadius_mm;
  tool.shaft = haptics::standardShaft(tool.head);
  return tool;
}

/// A mouth around the block's molar: soft tissue wherever `distance_mm` is negative.
template <class Distance>
assets::SoftTissueField mouth(Distance&& distance_mm) {
  assets::SoftTissueField field;
  field.grid = {{151, 151, 151}, 1.0, {-95.0, -35.0, -20.0}};
  field.tissue.assign(field.grid.voxelCount(), static_cast<std::uint8_t>(assets::SoftTissue::lip));
  field.distance.resize(field.grid.voxelCount());
  assets::forVoxels(field.grid, [&](glm::ivec3 ijk, std::size_t v) {
    field.distance[v] = assets::SoftTissueField::stored(distance_mm(field.grid.centre_P_mm(ijk)));
  });
  return field;
}

class HandpieceDirection : public testing::Test {
 protected:
  const assets::Patient patient = test::blockWithMolar();
  const assets::PlannedCut cut = planGutter(patient, kUsualBurRadius_mm).value();
  const haptics::Tool tool = roundBur();
};

TEST_F(HandpieceDirection, LeadsThroughTheMouthsOpening) {
  // A tube of 19 mm radius that leans by 30 degrees to any side.
  for (const glm::dvec2& lean : {glm::dvec2(0.5, 0.0), glm::dvec2(-0.5, 0.0), glm::dvec2(0.0, -0.5)}) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(lean, 0.85));
    const glm::dvec3 from = cut.surface_P_mm - 10.0 * axis;
    const auto soft = mouth([&](const glm::dvec3& p) { return 19.0 - glm::length(glm::cross(p - from, axis)); });
    const glm::dvec3 direction = handpieceDirection_P(cut, patient.ct, soft, tool);
    EXPECT_NEAR(glm::length(direction), 1.0, 1e-12);
    EXPECT_GT(glm::dot(direction, axis), 0.97);
    const HandpieceRoom room = handpieceRoom(cut, patient.ct, soft, tool, direction);
    EXPECT_GE(room.soft_mm, 0.0);
    EXPECT_LT(handpieceRoom(cut, patient.ct, soft, tool, {-axis.x, -axis.y, axis.z}).soft_mm, -5.0);
  }
}

TEST_F(HandpieceDirection, KeepsTheShaftOutOfBoneAndOutOfTheLineOfSight) {
  const glm::dvec3 direction = handpieceDirection_P(cut, patient.ct, {}, tool);
  EXPECT_LT(handpieceRoom(cut, patient.ct, {}, tool, direction).in_bone_share, 0.2);
  assets::PlannedCut seen_along_it = cut;
  seen_along_it.sight_P = direction;
  constexpr double kHiddenWithin = 0.985;  // cosine of 10 degrees
  EXPECT_LT(glm::dot(handpieceDirection_P(seen_along_it, patient.ct, {}, tool), direction), kHiddenWithin);
}

/// Under a roof: as little room as two millimetres over the highest place of the cut.
TEST_F(HandpieceDirection, CountsTheWayOverTheBoneFromStrokeToStroke) {
  const auto soft = mouth([&](const glm::dvec3& p) { return 34.0 - p.z; });
  haptics::Tool alone = tool;
  alone.handpiece = false;
  const glm::dvec3 out = glm::normalize(cut.outward_P);
  assets::PlannedCut over = cut;
  over.strokes_P_mm = {{cut.strokes_P_mm.front().front()}};
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke)
      if (glm::dot(p - over.strokes_P_mm[0][0], out) > 0.0) over.strokes_P_mm[0][0] = p;
  over.strokes_P_mm[0][0] += 2.0 * out;
  over.outward_P = glm::dvec3(0.0);
  EXPECT_LE(handpieceRoom(cut, patient.ct, soft, alone, out).soft_mm,
            handpieceRoom(over, patient.ct, soft, alone, out).soft_mm + 0.3);
}

TEST_F(HandpieceDirection, ABurAloneHasMoreRoom) {
  const auto soft = mouth([&](const glm::dvec3& p) { return 40.0 - p.z; });
  haptics::Tool alone = tool;
  alone.handpiece = false;
  EXPECT_LT(handpieceRoom(cut, patient.ct, soft, tool, cut.outward_P).soft_mm, 0.0);
  EXPECT_GT(handpieceRoom(cut, patient.ct, soft, alone, cut.outward_P).soft_mm, 0.0);
}

TEST_F(HandpieceDirection, OfNoCutIsNone) {
  EXPECT_EQ(handpieceDirection_P({}, patient.ct, {}, tool), glm::dvec3(0.0));
}

}  // namespace
}  // namespace app
