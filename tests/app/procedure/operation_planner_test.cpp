// What a scripted hand does next to a tooth in a block of bone.

#include "app/procedure/third_molar/operation_planner.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/body/components.h"
#include "tests/app/procedure/third_molar_phantom.h"

namespace app {
namespace {

TEST(OperationPlanner, PartsTheToothThenTakesItOutPieceByPiece) {
  Operation operation{phantom(-6.5)};  // nothing but the tips of the roots is held
  OperationPlanner planner(operation.patient, kBur_mm);
  assets::CtVolume& ct = operation.patient.ct;
  OperationStep step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const CutStep* section = std::get_if<CutStep>(&step.what);
  ASSERT_NE(section, nullptr);
  EXPECT_EQ(step.words, "part the tooth");
  sweep(ct, section->cut);
  ASSERT_EQ(piecesOf(ct), 2U);

  for (int piece = 0; piece < 2; ++piece) {
    step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
    const DeliveryStep* delivery = std::get_if<DeliveryStep>(&step.what);
    ASSERT_NE(delivery, nullptr) << step.words;
    EXPECT_EQ(delivery->piece, 0U) << "both are in one body here";
    EXPECT_TRUE(isInTooth(delivery->grip_P_mm));
    ASSERT_FALSE(delivery->path_X_PQ.empty());
    EXPECT_GT(delivery->path_X_PQ.back().translation_mm.z, 6.0);
    // Out with the one that was gripped.
    operation.is_any_out = true;
    std::vector<std::uint8_t> tooth(ct.solid.size());
    for (std::size_t v = 0; v < tooth.size(); ++v) tooth[v] = ct.tooth[v] == kFdi ? ct.solid[v] : std::uint8_t{0};
    const haptics::Components components(ct.grid, tooth);
    const int gripped = components.pieceAt(glm::ivec3(glm::round(ct.grid.indexFromPoint(delivery->grip_P_mm))));
    ASSERT_GE(gripped, 0);
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (components.pieceAt(ijk) == gripped) ct.solid[v] = 0;
    });
  }
  step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const EndStep* end = std::get_if<EndStep>(&step.what);
  ASSERT_NE(end, nullptr);
  EXPECT_EQ(end->why_not, "");
}

// The servo's tooth fades into the bone around it: what it has beyond its labels is to be parted, too.
TEST(OperationPlanner, PartsTheToothAsBroadAsTheServoHasIt) {
  Operation operation{phantom(-6.5)};
  assets::CtVolume& ct = operation.patient.ct;
  OperationPlanner planner(operation.patient, kBur_mm);
  const std::vector<std::uint8_t> narrow = ct.tooth;
  constexpr int kBeyond = 3;  // voxels
  assets::forVoxels(glm::ivec3(kBeyond), ct.grid.size - kBeyond, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    for (int x = -kBeyond; x <= kBeyond && narrow[v] == 0; ++x)
      if (narrow[ct.grid.index(ijk + glm::ivec3(x, 0, 0))] == kFdi) ct.tooth[v] = kFdi, ct.solid[v] = 255;
  });
  const OperationStep step = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const CutStep* const section = std::get_if<CutStep>(&step.what);
  ASSERT_NE(section, nullptr) << step.words;
  sweep(ct, section->cut);
  EXPECT_EQ(piecesOf(ct), 2U) << "the first section goes through all of it";
}

TEST(OperationPlanner, GivesUpOnAToothThatStaysWhole) {
  const Operation operation{phantom(3.0)};
  OperationPlanner planner(operation.patient, kBur_mm);
  int cuts = 0;
  for (;; ++cuts) {
    ASSERT_LT(cuts, 10);
    const OperationStep step = planner.next(operation.copy(), operation.patient.ct.grid, glm::ivec3(0));
    if (std::holds_alternative<CutStep>(step.what)) continue;
    const EndStep* end = std::get_if<EndStep>(&step.what);
    ASSERT_NE(end, nullptr);
    EXPECT_FALSE(end->why_not.empty());
    break;
  }
  EXPECT_EQ(cuts, 4);
}

TEST(OperationPlanner, TakesPiecesThatTouchAlongABreakForPieces) {
  const Operation operation{phantom(-6.5)};
  const assets::VolumeGrid& grid = operation.patient.ct.grid;
  OperationPlanner planner(operation.patient, kBur_mm, true);
  ASSERT_TRUE(std::holds_alternative<CutStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
  BodiesCopy halves = operation.copy();
  halves.piece[1].assign(halves.piece[0].size(), 0);
  const double middle_y_mm = operation.patient.site->centre_P_mm.y;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (grid.centre_P_mm(ijk).y > middle_y_mm) std::swap(halves.piece[0][v], halves.piece[1][v]);
  });
  const OperationStep next = planner.next(halves, grid, glm::ivec3(0));
  EXPECT_TRUE(std::holds_alternative<DeliveryStep>(next.what)) << next.words;
}

TEST(OperationPlanner, ASmallPieceThatDidNotComeWaitsForTheOthers) {
  const Operation operation{phantom(8.0)};
  const assets::VolumeGrid& grid = operation.patient.ct.grid;
  OperationPlanner planner(operation.patient, kBur_mm, true);
  ASSERT_TRUE(std::holds_alternative<CutStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
  // Two halves under bone, and a corner of the crown that nothing covers.
  BodiesCopy parted = operation.copy();
  for (std::size_t piece : {1, 2}) parted.piece[piece].assign(parted.piece[0].size(), 0);
  const double middle_y_mm = operation.patient.site->centre_P_mm.y;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = grid.centre_P_mm(ijk);
    const bool is_corner = p.x < 0.0 && p.y > 2.0 && p.z > 4.0;
    if (is_corner || (p.x < 0.6 && p.y > 1.6 && p.z > 3.6)) parted.jaw[v] = 0;
    if (p.y > middle_y_mm) std::swap(parted.piece[0][v], parted.piece[is_corner ? 2 : 1][v]);
  });
  const OperationStep first = planner.next(parted, grid, glm::ivec3(0));
  const DeliveryStep* const pulled = std::get_if<DeliveryStep>(&first.what);
  ASSERT_NE(pulled, nullptr) << first.words;
  ASSERT_EQ(pulled->piece, 2u) << first.words;
  // Once more after what is in its way was cleared, then no more.
  int times = 1;
  for (int call = 0; call < 5; ++call) {
    const OperationStep next = planner.next(parted, grid, glm::ivec3(0));
    const DeliveryStep* const again = std::get_if<DeliveryStep>(&next.what);
    times += again != nullptr && again->piece == 2 ? 1 : 0;
  }
  EXPECT_LE(times, 2);
}

TEST(OperationPlanner, TwistsTheLastSlotOpenWhereTheBurDidNotPartTheTooth) {
  const Operation operation{phantom(3.0)};
  const assets::VolumeGrid& grid = operation.patient.ct.grid;
  OperationPlanner planner(operation.patient, kBur_mm, true);
  assets::PlannedCut cut;
  for (int section = 0; section < 4; ++section) {
    const OperationStep step = planner.next(operation.copy(), grid, glm::ivec3(0));
    ASSERT_TRUE(std::holds_alternative<CutStep>(step.what)) << step.words;
    cut = std::get<CutStep>(step.what).cut;
  }
  const OperationStep next = planner.next(operation.copy(), grid, glm::ivec3(0));
  const SplitStep* const split = std::get_if<SplitStep>(&next.what);
  ASSERT_NE(split, nullptr) << next.words;
  EXPECT_NEAR(glm::length(split->along_P), 1.0, 1e-9);
  EXPECT_NEAR(glm::dot(split->along_P, split->out_P), 0.0, 1e-9);
  // Where the bur was, over the slot's floor.
  double nearest_mm = 1e9, deepest_mm = 1e9;
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n + 1 < stroke.size(); ++n) {
      nearest_mm = std::min(nearest_mm, glm::distance(split->tip_P_mm, 0.5 * (stroke[n] + stroke[n + 1])));
      deepest_mm = std::min(deepest_mm, glm::dot(stroke[n], split->out_P));
    }
  EXPECT_LT(nearest_mm, 1e-9);
  EXPECT_LT(glm::dot(split->tip_P_mm, split->out_P) - deepest_mm, 1.5);
  // It stayed whole: the slots before are tried too.
  for (int section = 1; section < 4; ++section)
    EXPECT_TRUE(std::holds_alternative<SplitStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
  EXPECT_TRUE(std::holds_alternative<EndStep>(planner.next(operation.copy(), grid, glm::ivec3(0)).what));
}

TEST(OperationPlanner, TakesAwayWhatBlocksAPieceBeforeItIsGripped) {
  Operation operation{phantom(8.0)};
  assets::CtVolume& ct = operation.patient.ct;
  OperationPlanner planner(operation.patient, kBur_mm);
  const OperationStep first = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  ASSERT_TRUE(std::holds_alternative<CutStep>(first.what));
  sweep(ct, std::get<CutStep>(first.what).cut);
  ASSERT_EQ(piecesOf(ct), 2U);
  const OperationStep next = planner.next(operation.copy(), ct.grid, glm::ivec3(0));
  const CutStep* cut = std::get_if<CutStep>(&next.what);
  ASSERT_NE(cut, nullptr) << next.words;
  EXPECT_NE(next.words.find("blocks"), std::string::npos);
}

TEST(OperationPlanner, PartsAToothOfWhichACornerHasBrokenOff) {
  Operation operation{phantom(-6.5)};
  OperationPlanner planner(operation.patient, kBur_mm);
  assets::CtVolume& ct = operation.patient.ct;
  EXPECT_EQ(planner.next(operation.copy(), ct.grid, glm::ivec3(0)).words, "part the tooth");
  // A plane cut through one corner of the crown.
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    if (ct.tooth[v] == kFdi && std::abs(p.y - 2.2) < 0.5 && p.x < -0.4 && p.z > 2.6) ct.solid[v] = 0;
    if (ct.tooth[v] == kFdi && std::abs(p.z - 2.8) < 0.5 && p.x < -0.4 && p.y > 1.8) ct.solid[v] = 0;
    if (ct.tooth[v] == kFdi && std::abs(p.x + 0.6) < 0.5 && p.z > 2.6 && p.y > 1.8) ct.solid[v] = 0;
  });
  ASSERT_EQ(piecesOf(ct), 2U);
  EXPECT_EQ(planner.next(operation.copy(), ct.grid, glm::ivec3(0)).words, "part the tooth");
}

TEST(OperationPlanner, LeadsAMovedPieceFromWhereItLies) {
  Operation operation{phantom(-6.5)};
  operation.is_any_out = true;
  assets::CtVolume& ct = operation.patient.ct;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] == kFdi && ct.grid.centre_P_mm(ijk).y < 0.0) ct.solid[v] = 0;
  });
  OperationPlanner planner(operation.patient, kBur_mm);
  // A whole tooth was seen first, so that what is left is a part of it.
  (void)planner.next(Operation{phantom(-6.5)}.copy(), ct.grid, glm::ivec3(0));
  BodiesCopy bodies = operation.copy();
  bodies.X_PQ[0] = {glm::angleAxis(0.2, glm::dvec3(0.0, 0.0, 1.0)), {0.4, 0.0, 0.8}};
  const OperationStep step = planner.next(bodies, ct.grid, glm::ivec3(0));
  const DeliveryStep* delivery = std::get_if<DeliveryStep>(&step.what);
  ASSERT_NE(delivery, nullptr) << step.words;
  EXPECT_LT(glm::distance(delivery->path_X_PQ.front().translation_mm, bodies.X_PQ[0].translation_mm), 1.0);
  EXPECT_GT(std::abs(glm::dot(delivery->path_X_PQ.front().rotation, bodies.X_PQ[0].rotation)), 0.999);
}

}  // namespace
}  // namespace app
