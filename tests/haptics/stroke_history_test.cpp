#include "haptics/bone/stroke_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

#include "haptics/bone/carve.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/time_erosion.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Tool;

/// All observable state of a bone.
struct Whole {
  std::vector<BlockState> blocks;
  std::vector<std::uint32_t> sums;
  std::uint64_t digest;
  std::array<double, assets::kTissueCount> removed_mm3;
};

std::size_t blockCount(const CarvedBone& bone) { return bone.field().blockAt({0, 0, bone.field().blocks.z}); }

Whole wholeOf(const CarvedBone& bone) {
  Whole whole{{}, {}, bone.digest(), bone.removedByTissue_mm3()};
  const SolidField at = bone.field();
  for (std::size_t n = 0; n < blockCount(bone); ++n) {
    whole.blocks.push_back(bone.stateOf(n));
    const std::size_t slot = at.slotOf(n);
    whole.sums.insert(whole.sums.end(),
                      {at.weight[slot], at.weight_x[slot], at.weight_y[slot], at.weight_z[slot], at.grey[slot]});
  }
  return whole;
}

void expectSame(const Whole& a, const Whole& b) {
  EXPECT_TRUE(a.blocks == b.blocks);
  EXPECT_EQ(a.sums, b.sums);
  EXPECT_EQ(a.digest, b.digest);
  EXPECT_EQ(a.removed_mm3, b.removed_mm3);
}

/// A block of grey noise, its labels mixed within blocks of voxels.
CarvedBone noise(unsigned seed) {
  std::mt19937 random(seed);
  Phantom phantom = block(3.0, 0.2);
  for (auto& solid : phantom.solid) solid = static_cast<std::uint8_t>(random() % 256);
  std::vector<std::uint8_t> label(phantom.solid.size());
  for (auto& one : label) one = static_cast<std::uint8_t>(random() % 7);
  return {phantom.grid, phantom.solid, label};
}

/// A bur of a random shape on a random way, cutting evenly or by its sliding speed.
struct Stroke {
  BurShape head;
  calibration::Pose<Patient, Tool> from, to;
  ErosionStep step;
  std::uint64_t first_tick;

  explicit Stroke(std::mt19937& random) {
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    const auto kind = static_cast<ShapeKind>(random() % 4);
    head = {kind, 0.7 + 0.3 * part(random), kind == ShapeKind::sphere ? 0.0 : 1.5 + part(random)};
    for (auto* pose : {&from, &to}) {
      pose->rotation = glm::normalize(glm::dquat(part(random), part(random), part(random), part(random)));
      pose->translation_mm = 2.5 * glm::dvec3(part(random), part(random), part(random));
    }
    step.loss.fill(0.05 + 0.04 * part(random));
    step.speed_share = random() % 2 == 0 ? 0.0 : 1.0;
    first_tick = random();
  }

  CarveResult cut(CarvedBone& bone, StrokeHistory* strokes, std::uint64_t tick) const {
    const double along = static_cast<double>(tick) / 29.0;
    return carveTool(bone, head, {from.rotation, glm::mix(from.translation_mm, to.translation_mm, along)}, step,
                     first_tick + tick, 1 + static_cast<int>(tick % 3), strokes);
  }
  double cutAll(CarvedBone& bone, StrokeHistory* strokes) const {
    double removed_mm3 = 0.0;
    for (std::uint64_t tick = 0; tick < 30; ++tick) removed_mm3 += cut(bone, strokes, tick).removed_mm3;
    if (strokes != nullptr) strokes->endStroke();
    return removed_mm3;
  }
};

/// Gives the newest stroke back in parts of `most` blocks.
double undoOne(StrokeHistory& strokes, CarvedBone& bone, std::size_t most) {
  double volume_mm3 = 0.0;
  const std::size_t before = strokes.strokes();
  for (;;) {
    const StrokeHistory::Restored given = strokes.undo(bone, most);
    EXPECT_LE(given.blocks, most);
    EXPECT_GT(given.blocks, 0u);
    volume_mm3 += given.volume_mm3;
    if (strokes.strokes() < before || given.blocks == 0) return volume_mm3;
  }
}

TEST(StrokeHistory, GivesBackEveryByteSumAndFigureOfAnyStroke) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    std::mt19937 random(seed);
    CarvedBone bone = noise(seed);
    StrokeHistory strokes(bone);
    std::vector<Whole> past;
    std::vector<double> removed_mm3;
    for (int n = 0; n < 5; ++n) {
      past.push_back(wholeOf(bone));
      removed_mm3.push_back(Stroke(random).cutAll(bone, &strokes));
    }
    ASSERT_EQ(strokes.strokes(), 5u);
    for (int n = 5; n-- > 0;) {
      const double returned_mm3 = undoOne(strokes, bone, 1 + random() % 100);
      EXPECT_NEAR(returned_mm3, removed_mm3[static_cast<std::size_t>(n)], 1e-9);
      expectSame(wholeOf(bone), past[static_cast<std::size_t>(n)]);
      ASSERT_EQ(strokes.strokes(), static_cast<std::size_t>(n));
    }
  }
}

TEST(StrokeHistory, LeavesABoneThatCutsLikeOneNeverCut) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    CarvedBone bone = noise(seed), never = noise(seed);
    StrokeHistory strokes(bone);
    Stroke(random).cutAll(bone, &strokes);
    undoOne(strokes, bone, 64);
    const Stroke next(random);
    EXPECT_EQ(next.cutAll(bone, &strokes), next.cutAll(never, nullptr));
    expectSame(wholeOf(bone), wholeOf(never));
  }
}

TEST(StrokeHistory, CutsTheSameWhetherStrokesAreKeptOrNot) {
  std::mt19937 random(5);
  CarvedBone bone = noise(5), without = noise(5);
  StrokeHistory strokes(bone);
  for (int n = 0; n < 4; ++n) {
    const Stroke stroke(random);
    EXPECT_EQ(stroke.cutAll(bone, &strokes), stroke.cutAll(without, nullptr));
  }
  expectSame(wholeOf(bone), wholeOf(without));
}

TEST(StrokeHistory, GivesBackBlocksThatCouldNotBeRemembered) {
  CarvedBone bone = block(6.4, 0.1).bone(1);
  StrokeHistory strokes(bone);
  ErosionStep step;
  step.loss.fill(0.7);
  std::uint64_t tick = 0;
  while (bone.blocksLeft() > 0) {
    const double at = -6.0 + 1.5 * static_cast<double>(tick % 9);
    carveSphere(bone, {{at, at, -6.0 + 1.5 * static_cast<double>(tick / 9 % 9)}}, 3.0, step, tick);
    carveSphere(bone, {{-at, at, -6.0 + 1.5 * static_cast<double>(tick / 9 % 9)}}, 3.0, step, tick);
    ++tick;
  }
  for (double x : {-5.0, 5.0}) {
    const Whole before = wholeOf(bone);
    EXPECT_GT(carveSphere(bone, {{x, 0.0, 0.0}}, 1.5, step, tick++, 1, &strokes).removed_mm3, 1.0);
    undoOne(strokes, bone, 50);
    expectSame(wholeOf(bone), before);
  }
}

TEST(StrokeHistory, ForgetsTheOldestStrokesWholeWhenItsRoomIsFull) {
  std::mt19937 random(9);
  CarvedBone bone = noise(9);
  StrokeHistory strokes(bone, 800);
  std::vector<Whole> past;
  for (int n = 0; n < 60; ++n) {
    past.push_back(wholeOf(bone));
    Stroke(random).cutAll(bone, &strokes);
    ASSERT_LE(strokes.strokes(), StrokeHistory::kMaxStrokes);
  }
  const std::size_t kept = strokes.strokes();
  EXPECT_GE(kept, 3u);
  EXPECT_LT(kept, StrokeHistory::kMaxStrokes);
  for (std::size_t n = 0; n < kept; ++n) {
    undoOne(strokes, bone, 37);
    expectSame(wholeOf(bone), past[past.size() - 1 - n]);
  }
  EXPECT_EQ(strokes.undo(bone, 100).blocks, 0u);
}

TEST(StrokeHistory, KeepsAsManyStrokesAsItSays) {
  CarvedBone bone = noise(1);
  StrokeHistory strokes(bone);
  for (int n = 0; n < 300; ++n) {
    carveSphere(bone, {{-2.0 + 0.013 * n, 0.0, 0.0}}, 0.5, phantom::timeErosion({}, 0.01), 0, 1, &strokes);
    strokes.endStroke();
  }
  EXPECT_EQ(strokes.strokes(), StrokeHistory::kMaxStrokes);
}

TEST(StrokeHistory, TakesALongStrokeBackInPiecesWithoutHalfABlock) {
  // Room for 4 pieces of 40 blocks; the stroke meets more of them, and comes back to where its last pieces began.
  CarvedBone bone = block(3.0, 0.2).bone(1);
  StrokeHistory strokes(bone, 160);
  std::vector<Whole> past{wholeOf(bone)};
  for (std::uint64_t tick = 0; tick < 120; ++tick) {
    carveSphere(bone, {{-2.5 + 0.04 * static_cast<double>(tick), 0.0, 0.0}}, 1.0, phantom::timeErosion({}, 0.02), tick,
                1, &strokes);
    past.push_back(wholeOf(bone));
  }
  const auto once_was = [&](const Whole& now) {
    for (std::size_t tick = 1; tick < past.size(); ++tick) {
      bool all = true;
      for (std::size_t n = 0; n < now.blocks.size() && all; ++n)
        all = now.blocks[n] == past[tick].blocks[n] || now.blocks[n] == past[tick - 1].blocks[n];
      if (all) return true;
    }
    return false;
  };
  ASSERT_GE(strokes.strokes(), 3u);
  while (strokes.strokes() > 0) {
    const std::uint64_t before = bone.digest();
    undoOne(strokes, bone, 16);
    EXPECT_NE(bone.digest(), before);
    EXPECT_TRUE(once_was(wholeOf(bone)));
  }
}

TEST(StrokeHistory, StaysInItsRoomUnderRandomUse) {
  std::mt19937 random(17);
  CarvedBone bone = noise(17);
  const Whole first = wholeOf(bone);
  StrokeHistory strokes(bone, 300);
  for (int n = 0; n < 400; ++n) {
    const auto what = static_cast<unsigned>(random() % 5);
    if (what == 0) strokes.undo(bone, random() % 80);
    if (what == 4) strokes.redo(bone, random() % 80);
    if (what == 1) strokes.endStroke();
    if (what == 2 || what == 3) Stroke(random).cut(bone, &strokes, random() % 30);
  }
  while (strokes.strokes() > 0) undoOne(strokes, bone, 64);
  // Whatever was forgotten: no voxel holds more than it did, and the sums are those of its bytes.
  const Whole now = wholeOf(bone);
  for (std::size_t n = 0; n < now.blocks.size(); ++n) {
    std::uint32_t weight = 0;
    for (std::size_t voxel = 0; voxel < kBlockVoxels; ++voxel) {
      ASSERT_LE(now.blocks[n].solid[voxel], first.blocks[n].solid[voxel]);
      weight += now.blocks[n].solid[voxel];
    }
    ASSERT_EQ(bone.field().weight[bone.field().slotOf(n)], weight);
  }
}

/// Redoes one stroke in parts of `most` blocks.
void redoOne(StrokeHistory& strokes, CarvedBone& bone, std::size_t most) {
  do EXPECT_LE(strokes.redo(bone, most).blocks, most);
  while (strokes.isBetweenStrokes());
}

TEST(StrokeHistory, IsTheBoneOfItsPlaceAfterAnyUndoRedoAndNewStroke) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    CarvedBone bone = noise(seed);
    StrokeHistory strokes(bone);
    // The slow twin keeps the whole bone before and after every stroke.
    std::vector<Whole> states{wholeOf(bone)};
    std::size_t at = 0;
    for (int n = 0; n < 60; ++n) {
      const std::size_t most = 1 + random() % 60;
      switch (random() % 4) {
        case 0:
          if (at == 0) break;
          undoOne(strokes, bone, most);
          --at;
          break;
        case 1:
          if (at + 1 == states.size()) break;
          redoOne(strokes, bone, most);
          ++at;
          break;
        case 2: {
          // Begun, then turned back within the stroke.
          if (at == 0) break;
          strokes.undo(bone, 1);
          if (strokes.isBetweenStrokes())
            redoOne(strokes, bone, most);
          else
            --at;
          break;
        }
        default:
          Stroke(random).cutAll(bone, &strokes);
          if (bone.digest() == states[at].digest) break;  // beside the bone
          states.resize(++at);
          states.push_back(wholeOf(bone));
      }
      expectSame(wholeOf(bone), states[at]);
      ASSERT_EQ(strokes.strokes(), at) << "seed " << seed << ", step " << n;
      ASSERT_EQ(strokes.undoneStrokes(), states.size() - 1 - at);
    }
  }
}

TEST(StrokeHistory, ANewStrokeDropsWhatCouldBeRedone) {
  std::mt19937 random(3);
  CarvedBone bone = noise(3);
  StrokeHistory strokes(bone);
  for (int n = 0; n < 4; ++n) Stroke(random).cutAll(bone, &strokes);
  for (int n = 0; n < 3; ++n) undoOne(strokes, bone, 64);
  EXPECT_EQ(strokes.undoneStrokes(), 3u);
  Stroke(random).cutAll(bone, &strokes);
  EXPECT_EQ(strokes.undoneStrokes(), 0u);
  const std::uint64_t digest = bone.digest();
  EXPECT_EQ(strokes.redo(bone, 1000).blocks, 0u);
  EXPECT_EQ(bone.digest(), digest);
}

TEST(StrokeHistory, MarksTheBricksThatComeBack) {
  CarvedBone bone = block(3.0, 0.2).bone(1);
  StrokeHistory strokes(bone);
  const std::vector<std::uint8_t> before = bone.solidInGridOrder();
  carveSphere(bone, {{0.7, -0.4, 0.3}}, 1.7, phantom::timeErosion({}, 0.1), 0, 1, &strokes);
  std::vector<glm::ivec3> cut, returned;
  bone.dirtyBricks().takeInto(cut);
  ASSERT_FALSE(cut.empty());
  undoOne(strokes, bone, 1000);
  bone.dirtyBricks().takeInto(returned);
  EXPECT_EQ(cut, returned);
  EXPECT_EQ(bone.solidInGridOrder(), before);
}

TEST(StrokeHistory, HandsBricksToAReaderWhileTheyComeBack) {
  CarvedBone bone = block(3.0, 0.2).bone(1);
  StrokeHistory strokes(bone);
  std::vector<std::uint8_t> seen = bone.solidInGridOrder();
  const auto take = [&] {
    std::vector<glm::ivec3> bricks;
    bone.dirtyBricks().takeInto(bricks);
    for (glm::ivec3 brick : bricks) {
      std::array<std::uint8_t, 512> copy{};
      bone.copyBrick(brick, copy);
      for (int n = 0; n < 512; ++n) {
        const glm::ivec3 ijk = brick * 8 + glm::ivec3(n % 8, n / 8 % 8, n / 64);
        if (bone.grid().contains(ijk)) seen[bone.grid().index(ijk)] = copy[static_cast<std::size_t>(n)];
      }
    }
  };
  std::atomic<bool> done{false};
  std::thread reader([&] {
    while (!done.load()) take();
  });
  for (std::uint64_t tick = 0; tick < 300; ++tick) {
    carveSphere(bone, {{-1.0 + 0.006 * static_cast<double>(tick), 0.0, 0.0}}, 1.0, phantom::timeErosion({}, 2e-3), tick,
                1, &strokes);
    if (tick % 3 == 2) strokes.endStroke();
    if (tick % 5 == 4) strokes.undo(bone, 20);
  }
  done.store(true);
  reader.join();
  take();
  EXPECT_EQ(seen, bone.solidInGridOrder());
}

TEST(StrokeHistory, TakesNoMoreRoomThanItSays) {
  const CarvedBone bone = block(6.4, 0.1).bone();
  EXPECT_LT(StrokeHistory(bone).bytes(), 16'000'000u);
}

/// Strokes of something else are counted, undone and redone among those of the drill, with what was saved to them
/// later.
TEST(StrokeHistory, KeepsTheOrderOfMarkedStrokes) {
  std::mt19937 random(11);
  CarvedBone bone = noise(11);
  StrokeHistory strokes(bone);
  std::vector<std::uint64_t> digests{bone.digest()};
  const std::vector<bool> marked{true, false, true, true, false, true};
  for (const bool mark : marked) {
    mark ? strokes.addMarked() : static_cast<void>(Stroke(random).cutAll(bone, &strokes));
    digests.push_back(bone.digest());
  }
  // The last one gets blocks after all.
  strokes.reopen();
  Stroke(random).cutAll(bone, &strokes);
  digests.back() = bone.digest();
  ASSERT_EQ(strokes.strokes(), marked.size());
  std::vector<std::size_t> places;
  for (std::size_t n = 0; n < marked.size(); ++n) {
    EXPECT_EQ(strokes.isMarked(n), marked[n]) << n;
    places.push_back(strokes.place(n));
  }
  for (std::size_t n = marked.size(); n > 0; --n) {
    while (strokes.strokes() == n) strokes.undo(bone, 7);
    EXPECT_EQ(bone.digest(), digests[n - 1]);
    EXPECT_EQ(strokes.isMarked(n - 1), marked[n - 1]) << "and can be redone";
    EXPECT_EQ(strokes.place(n - 1), places[n - 1]);
  }
  for (std::size_t n = 0; n < marked.size(); ++n) {
    do {
      strokes.redo(bone, 7);
    } while (strokes.isBetweenStrokes());
    EXPECT_EQ(strokes.strokes(), n + 1);
    EXPECT_EQ(bone.digest(), digests[n + 1]);
  }
  // A new one drops what was undone, not those before it.
  while (strokes.strokes() == 6) strokes.undo(bone, 100);
  strokes.undo(bone, 100);
  Stroke(random).cutAll(bone, &strokes);
  EXPECT_EQ(strokes.strokes(), 5u);
  EXPECT_EQ(strokes.undoneStrokes(), 0u);
  EXPECT_TRUE(strokes.isMarked(3));
  EXPECT_FALSE(strokes.isMarked(4));
  strokes.undo(bone, 100'000);
  strokes.undo(bone, 1);
  strokes.addMarked();
  EXPECT_EQ(strokes.strokes(), 4u);
  strokes.dropOldest();
  EXPECT_EQ(strokes.strokes(), 3u);
  EXPECT_FALSE(strokes.isMarked(0));
}

/// Undone in part and given up: the mark stays, its blocks go.
TEST(StrokeHistory, AMarkedStrokeIsNotDroppedForWantOfBlocks) {
  CarvedBone bone = noise(3);
  StrokeHistory strokes(bone);
  strokes.addMarked();
  std::mt19937 random(3);
  Stroke(random).cutAll(bone, &strokes);
  while (strokes.strokes() == 2) strokes.undo(bone, 100);
  strokes.addMarked();
  EXPECT_EQ(strokes.strokes(), 2u);
  EXPECT_TRUE(strokes.isMarked(0) && strokes.isMarked(1));
}

}  // namespace
}  // namespace haptics
