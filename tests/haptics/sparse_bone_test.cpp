// Bone whose even blocks share slots, against the same bone with a slot for every block: the same bits of field, force,
// digest, books and undo; and what happens when no slot is left.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "haptics/bone/carve.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/contact/law.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/time_erosion.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Pose;
using calibration::Tool;

struct Tooth {
  Phantom solid;
  std::vector<std::uint8_t> label;
  CarvedBone bone(BlockStorage storage) const { return CarvedBone(solid.grid, solid.solid, label, storage); }
};

/// Round, with a hole, of two tissues; a side is no whole number of blocks.
Tooth tooth() {
  Tooth made{filled(1.55, 0.05,
                    [](const glm::dvec3& p) {
                      const double in_hole_mm = 0.3 - glm::length(glm::dvec2(p.x, p.y));
                      return std::max(glm::length(p) - 1.4, p.z > -0.5 ? in_hole_mm : -1.0);
                    }),
             {}};
  made.label.resize(made.solid.solid.size());
  assets::forVoxels(made.solid.grid, [&](glm::ivec3 ijk, std::size_t v) {
    made.label[v] = made.solid.solid[v] == 0 ? 0 : ijk.z > 40 ? 4 : 5;
  });
  return made;
}

struct Move {
  BurShape head;
  Pose<Patient, Tool> X_PT;

  explicit Move(std::mt19937& random, double far_mm = 1.6) {
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    const auto kind = static_cast<ShapeKind>(random() % 4);
    head = {kind, 0.3 + 0.15 * part(random), kind == ShapeKind::sphere ? 0.0 : 0.5 + 0.3 * part(random)};
    X_PT = {glm::normalize(glm::dquat(part(random), part(random), part(random), 0.1)),
            far_mm * glm::dvec3(part(random), part(random), part(random))};
  }
};

void expectSame(CarvedBone& one, CarvedBone& other) {
  ASSERT_EQ(one.digest(), other.digest());
  ASSERT_TRUE(one.solidInGridOrder() == other.solidInGridOrder());
  ASSERT_TRUE(one.labelInGridOrder() == other.labelInGridOrder());
  ASSERT_EQ(one.removedByTissue_mm3(), other.removedByTissue_mm3());
  std::vector<std::size_t> written, other_written;
  one.takeWritten(written), other.takeWritten(other_written);
  ASSERT_EQ(written, other_written);
  for (std::size_t block = 0; block < one.blocks(); ++block) ASSERT_TRUE(one.stateOf(block) == other.stateOf(block));
  for (glm::ivec3 brick(0); brick.x < one.grid().bricks().x; ++brick.x) {
    std::array<std::uint8_t, 512> a{}, b{};
    one.copyBrick(brick, a), other.copyBrick(brick, b);
    ASSERT_EQ(a, b);
  }
}

TEST(SparseBone, IsTheDenseOneToTheBitOverStrokesUndoAndRedo) {
  const Tooth made = tooth();
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    CarvedBone dense = made.bone(BlockStorage::dense), sparse = made.bone(BlockStorage::sparse);
    EXPECT_LT(sparse.bytes(), dense.bytes());
    ASSERT_NO_FATAL_FAILURE(expectSame(dense, sparse));
    StrokeHistory dense_strokes(dense, 2000), sparse_strokes(sparse, 2000);
    for (std::uint64_t tick = 0; tick < 300; ++tick) {
      const auto what = random() % 12;
      if (what == 0) dense_strokes.endStroke(), sparse_strokes.endStroke();
      if (what == 1) {
        const std::size_t most = 1 + random() % 60;
        ASSERT_EQ(dense_strokes.undo(dense, most).volume_mm3, sparse_strokes.undo(sparse, most).volume_mm3);
      }
      if (what == 2) {
        ASSERT_EQ(dense_strokes.redo(dense, 40).blocks, sparse_strokes.redo(sparse, 40).blocks);
      }
      const Move move(random);
      LawSettings law;
      law.kind = static_cast<LawKind>(random() % kLaws.size());
      const Contact felt = contactOf(law, {dense.field(), move.head, move.X_PT, law.tissue, {}});
      const Contact other = contactOf(law, {sparse.field(), move.head, move.X_PT, law.tissue, {}});
      ASSERT_EQ(std::memcmp(&felt.force_P_N, &other.force_P_N, sizeof felt.force_P_N), 0) << tick;
      ErosionStep step;
      step.loss.fill(0.2 + 0.001 * static_cast<double>(random() % 500));
      const double removed = carveTool(dense, move.head, move.X_PT, step, tick, 1, &dense_strokes).removed_mm3;
      ASSERT_EQ(carveTool(sparse, move.head, move.X_PT, step, tick, 1, &sparse_strokes).removed_mm3, removed);
    }
    ASSERT_NO_FATAL_FAILURE(expectSame(dense, sparse));
    EXPECT_FALSE(sparse.cutsWholeBlocks());
  }
}

TEST(SparseBone, GivesPartsAwayAndTakesThemAsTheDenseOneDoes) {
  const Tooth made = tooth();
  std::mt19937 random(9);
  CarvedBone from[2] = {made.bone(BlockStorage::dense), made.bone(BlockStorage::sparse)};
  CarvedBone to[2] = {CarvedBone::emptied(made.solid.grid, made.solid.solid, made.label),
                      CarvedBone::emptied(made.solid.grid, made.solid.solid, made.label)};
  for (int n = 0; n < 3000; ++n) {
    const std::size_t block = random() % from[0].blocks();
    std::array<std::uint8_t, kBlockVoxels> given{};
    for (auto& one : given) one = static_cast<std::uint8_t>(random() % 3 == 0 ? 255 : random() % 256);
    for (int k = 0; k < 2; ++k)
      if (n % 2 == 0)
        from[k].moveBlock(block, given, to[k]);
      else
        from[k].loseBlock(block, given);
  }
  ASSERT_NO_FATAL_FAILURE(expectSame(from[0], from[1]));
  ASSERT_NO_FATAL_FAILURE(expectSame(to[0], to[1]));
}

/// More even blocks than there are slots in reserve.
constexpr double kHalf_mm = 3.2;

TEST(SparseBone, CutsWholeBlocksAtTheSameRateWhenNoSlotIsLeft) {
  const Phantom solid = block(kHalf_mm, 0.05);
  const std::vector<std::uint8_t> label(solid.solid.size(), 5);
  CarvedBone dense(solid.grid, solid.solid, label, BlockStorage::dense),
      bone(solid.grid, solid.solid, label, BlockStorage::sparse);
  ASSERT_EQ(bone.slotsLeft(), Cubelets::kReserve);
  StrokeHistory strokes(bone, 200000);
  const std::vector<std::uint8_t> first = bone.solidInGridOrder();
  const std::uint64_t first_digest = bone.digest();

  // Half of it goes: its slots.
  ErosionStep all;
  all.loss.fill(1.0);
  std::uint64_t tick = 0;
  for (double z = -kHalf_mm; bone.slotsLeft() > 0 && z < 0.4; z += 0.1)
    for (double y = -kHalf_mm; y <= kHalf_mm; y += 0.4)
      carveSweep(bone, {ShapeKind::sphere, 0.6, 0.0}, {{1, 0, 0, 0}, {-kHalf_mm, y, z}},
                 {{1, 0, 0, 0}, {kHalf_mm, y, z}}, all, tick++);
  ASSERT_EQ(bone.slotsLeft(), 0u);

  // A bur at rest where bone is whole takes as much a second as from dense bone, and no more than it covers.
  const BurShape head{ShapeKind::sphere, 1.2, 0.0};
  const Pose<Patient, Tool> X_PT{{1, 0, 0, 0}, {0.013, 0.021, 1.9}};
  ErosionStep slow;
  slow.loss.fill(0.002);
  double taken_mm3 = 0.0, dense_mm3 = 0.0;
  const std::uint64_t before = bone.digest();
  const std::size_t allocations = allocation_count::now();
  for (int n = 0; n < 200; ++n) {
    taken_mm3 += carveTool(bone, head, X_PT, slow, tick + static_cast<std::uint64_t>(n), 1, &strokes).removed_mm3;
    dense_mm3 += carveTool(dense, head, X_PT, slow, tick + static_cast<std::uint64_t>(n)).removed_mm3;
  }
  EXPECT_EQ(allocation_count::now(), allocations);
  EXPECT_TRUE(bone.cutsWholeBlocks());
  EXPECT_NEAR(taken_mm3, dense_mm3, 0.1 * dense_mm3);
  EXPECT_GT(dense_mm3, 1.5);

  // Undo puts back what went whole.
  strokes.endStroke();
  while (strokes.strokes() > 0) strokes.undo(bone, 1000);
  EXPECT_EQ(bone.digest(), before);
  // And all of it, by a copy of the first state.
  for (std::size_t b = 0; b < bone.blocks(); ++b) {
    BlockState whole;
    whole.solid.fill(255);
    bone.restoreBlock(b, whole);
  }
  EXPECT_EQ(bone.digest(), first_digest);
  EXPECT_TRUE(bone.solidInGridOrder() == first);
  for (const double removed_mm3 : bone.removedByTissue_mm3()) EXPECT_NEAR(removed_mm3, 0.0, 1e-9);
}

TEST(SparseBone, LosesNoPartOfABlockThatHasNoSlot) {
  const Phantom solid = block(kHalf_mm, 0.05);
  CarvedBone bone(solid.grid, solid.solid, {}, BlockStorage::sparse);
  std::array<std::uint8_t, kBlockVoxels> one{};
  one[7] = 255;
  std::int64_t lost = 0;
  for (std::size_t b = 0; b < bone.blocks(); ++b) lost += bone.loseBlock(b, one);
  EXPECT_EQ(lost, 255 * static_cast<std::int64_t>(Cubelets::kReserve));
  std::int64_t left = 0;
  for (const std::uint8_t byte : bone.solidInGridOrder()) left += byte;
  EXPECT_EQ(left + lost, 255 * static_cast<std::int64_t>(solid.solid.size()));
}

}  // namespace
}  // namespace haptics
