#include "assets/synthetic/practice_block.h"

#include <gtest/gtest.h>

#include "assets/cut_field.h"
#include "assets/tissue.h"

namespace assets {
namespace {

constexpr std::array kTasks{PracticeTask::plate, PracticeTask::groove, PracticeTask::ball};

/// By a lattice of cubes.
double targetVolume_mm3(PracticeTask task) {
  constexpr double kEdge_mm = 0.1;
  double volume = 0.0;
  for (double z = -6.0 + 0.05; z < 0.0; z += kEdge_mm)
    for (double y = -6.0 + 0.05; y < 6.0; y += kEdge_mm)
      for (double x = -6.0 + 0.05; x < 6.0; x += kEdge_mm)
        if (fromTarget_mm(task, fromBlock({x, y, z})) < 0.0) volume += kEdge_mm * kEdge_mm * kEdge_mm;
  return volume;
}

TEST(PracticeBlock, TargetsHaveTheirVolume) {
  EXPECT_NEAR(targetVolume_mm3(PracticeTask::plate), 10.0 * 8.0 * 2.0, 2.0);
  // Two mm deep: a millimetre of slot, half a cylinder and the halves of a ball at the ends.
  const double slot = 1.0 * (4.0 * 2.0 + 3.1416), round = 0.5 * 3.1416 * 4.0 + 2.0 / 3.0 * 3.1416;
  EXPECT_NEAR(targetVolume_mm3(PracticeTask::groove), slot + round, 0.5);
  EXPECT_NEAR(targetVolume_mm3(PracticeTask::ball), 3.1416 * 4.5 * 4.5 * 4.5, 6.0);
}

TEST(PracticeBlock, IsOnePieceOfBoneAboutItsFace) {
  for (const PracticeTask task : kTasks) {
    const Patient block = practiceBlock(task, 0.4);
    EXPECT_EQ(block.title, textOf(task).title);
    EXPECT_FALSE(block.site);
    EXPECT_EQ(block.focus_P_mm(), glm::dvec3(0.0));
    const auto label_at = [&](const glm::dvec3& q) {
      const glm::ivec3 ijk(glm::round(block.ct.grid.indexFromPoint(fromBlock(q))));
      return block.ct.grid.contains(ijk) ? Tissue{block.ct.label[block.ct.grid.index(ijk)]} : Tissue::unlabelled;
    };
    EXPECT_EQ(label_at({0.0, 0.0, 1.0}), Tissue::unlabelled);
    EXPECT_EQ(label_at({0.0, 0.0, -0.8}), Tissue::cortical);
    EXPECT_EQ(label_at({0.0, 0.0, -4.5}), task == PracticeTask::plate  ? Tissue::unlabelled
                                          : task == PracticeTask::ball ? Tissue::enamel
                                                                       : Tissue::cortical);
    EXPECT_EQ(practiceTaskOf(textOf(task).key), task);
  }
  EXPECT_FALSE(practiceTaskOf("usual"));
}

TEST(PracticeBlock, AxesOfTheBlockAreSquare) {
  const glm::dvec3 x = fromBlock({1, 0, 0}), y = fromBlock({0, 1, 0}), z = fromBlock({0, 0, 1});
  for (const double product : {glm::dot(x, y), glm::dot(y, z), glm::dot(z, x)}) EXPECT_NEAR(product, 0.0, 1e-12);
  EXPECT_NEAR(glm::dot(glm::cross(x, y), z), 1.0, 1e-12);
  EXPECT_NEAR(glm::distance(inBlock(fromBlock({1.0, 2.0, 3.0})), glm::dvec3(1.0, 2.0, 3.0)), 0.0, 1e-12);
}

TEST(PracticeBlock, TheScriptedStrokesTakeTheTargetAndLittleElse) {
  for (const PracticeTask task : kTasks) {
    const PlannedCut cut = practiceCut(task, textOf(task).bur_radius_mm);
    ASSERT_FALSE(cut.strokes_P_mm.empty());
    const CutField swept(cut, 3.0, false, 0.2);
    double target = 0.0, both = 0.0, outside = 0.0;
    for (double z = -5.9; z < 0.0; z += 0.2)
      for (double y = -6.0; y < 6.0; y += 0.2)
        for (double x = -6.0; x < 6.0; x += 0.2) {
          const glm::dvec3 p = fromBlock({x, y, z});
          const bool is_ball =
              task == PracticeTask::ball &&
              glm::distance(glm::dvec3(x, y, z), glm::dvec3(0.0, 0.0, kBallMiddle_mm)) < kBallRadius_mm + 0.4;
          if (is_ball) {
            if (glm::distance(glm::dvec3(x, y, z), glm::dvec3(0.0, 0.0, kBallMiddle_mm)) < kBallRadius_mm - 0.2) {
              EXPECT_GT(swept.distance_mm(p), -0.1) << "the ball is not touched";
            }
            continue;
          }
          const double from_mm = fromTarget_mm(task, p);
          const bool is_swept = swept.distance_mm(p) < 0.0;
          target += from_mm < 0.0, both += from_mm < 0.0 && is_swept, outside += from_mm > 0.3 && is_swept;
        }
    EXPECT_GT(both, 0.8 * target) << textOf(task).key;
    EXPECT_LT(outside, 0.03 * target) << textOf(task).key;
  }
}

}  // namespace
}  // namespace assets
