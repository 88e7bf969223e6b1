#include "haptics/bone/carve.h"

#include <gtest/gtest.h>

#include <limits>

#include "haptics/contact/shape_overlap.h"
#include "haptics/tool/bur_shape.h"
#include "tests/haptics/head_distance.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Pose;
using calibration::Tool;

const std::vector<BurShape> kShapes = {
    {ShapeKind::capsule, 0.8, 2.0}, {ShapeKind::cylinder, 0.8, 2.5}, {ShapeKind::cone, 1.0, 2.5}};
const Pose<Patient, Tool> kPose{glm::normalize(glm::dquat(1.0, 0.3, -0.5, 0.2)), {0.013, 0.031, -0.047}};

ErosionStep stepOf(double loss) {
  ErosionStep step;
  step.loss.fill(loss);
  return step;
}

TEST(CarveShape, TakesTheFeltOverlapTimesTheLoss) {
  for (const BurShape& head : kShapes) {
    CarvedBone bone = halfSpace(3.0, 0.1, glm::normalize(glm::dvec3(0.2, 0.3, 0.9))).bone();
    const double overlap = shapeOverlap(bone.field(), head, kPose, {}).volume_mm3;
    double removed = 0.0;
    for (std::uint64_t tick = 0; tick < 50; ++tick)
      removed += carveTool(bone, head, kPose, stepOf(0.004), tick).removed_mm3;
    EXPECT_NEAR(removed, 0.2 * overlap, 0.01 * removed) << static_cast<int>(head.kind);
  }
}

TEST(CarveShape, TakesItsOwnVolumeAndNoMoreHoweverLongItStays) {
  for (const BurShape& head : kShapes)
    for (const int turns : {1, 4}) {
      CarvedBone bone = block(3.0, 0.1).bone();
      double removed = 0.0;
      for (std::uint64_t tick = 0; tick < 240; ++tick)
        removed += carveTool(bone, head, kPose, stepOf(0.03), tick, turns).removed_mm3;
      EXPECT_NEAR(removed, volume_mm3(head), 0.005 * volume_mm3(head)) << static_cast<int>(head.kind);
      EXPECT_NEAR(removed, shapeOverlap(block(3.0, 0.1).field(), head, kPose, {}).volume_mm3, 0.003 * removed);
    }
}

TEST(CarveShape, RemovesNothingOutsideTheHead) {
  for (const BurShape& head : kShapes) {
    CarvedBone bone = block(2.4, 0.1).bone();
    for (std::uint64_t tick = 0; tick < 40; ++tick) carveTool(bone, head, kPose, stepOf(0.05), tick);
    for (int k = 0; k < bone.grid().size.z; ++k)
      for (int j = 0; j < bone.grid().size.y; ++j)
        for (int i = 0; i < bone.grid().size.x; ++i) {
          const calibration::Point<Patient> p_P{bone.grid().centre_P_mm({i, j, k})};
          const double away = headDistance_mm(head, kPose.inverse() * p_P);
          const std::uint8_t solid = bone.field().solidAt({i, j, k});
          // Twice the voxel's ball at the rim, where two faces are met one by one.
          if (away > 0.09) {
            EXPECT_EQ(solid, 255);
          } else if (away < -0.063) {
            EXPECT_EQ(solid, 0);
          }
        }
  }
}

TEST(CarveShape, IsTheSphereForASphere) {
  CarvedBone one = block(2.5, 0.2).bone(), other = block(2.5, 0.2).bone();
  for (std::uint64_t tick = 0; tick < 20; ++tick) {
    carveSphere(one, {kPose.translation_mm}, 1.5, stepOf(0.03), tick);
    carveTool(other, {ShapeKind::sphere, 1.5, 0.0}, kPose, stepOf(0.03), tick);
  }
  EXPECT_EQ(one.digest(), other.digest());
}

TEST(CarveShape, CutsHarderWhereItsSurfaceSlidesFaster) {
  // A cylinder about its own axis: the same over all, less near the axis, more at the rim.
  const BurShape head{ShapeKind::cylinder, 1.5, 1.0};
  CarvedBone bone = block(2.5, 0.1).bone();
  ErosionStep step = stepOf(0.1);
  step.speed_share = 1.0;
  step.mean_arm_mm = 1.0;  // 2/3 R over a disc
  const double removed = carveTool(bone, head, {}, step, 1).removed_mm3;
  EXPECT_NEAR(removed, 0.1 * volume_mm3(head), 0.01 * removed);
  const auto takenAt = [&](double x) {
    const glm::ivec3 ijk = glm::ivec3(glm::round(bone.grid().indexFromPoint({x, 0.0, 0.0})));
    return 1.0 - bone.field().solidAt(ijk) / 255.0;
  };
  EXPECT_LT(takenAt(0.0), 0.02);
  EXPECT_NEAR(takenAt(1.2), 0.12, 0.02);
}

TEST(CarveShape, SweepsAndTurnsAlongItsWay) {
  // A fissure bur tilted about its tip's side cuts a fan.
  const BurShape head{ShapeKind::cylinder, 0.5, 3.0};
  CarvedBone bone = block(2.5, 0.2).bone();
  const Pose<Patient, Tool> from{}, to{glm::angleAxis(glm::radians(50.0), glm::dvec3(1.0, 0.0, 0.0)), {}};
  double removed = 0.0;
  for (std::uint64_t tick = 0; tick < 30; ++tick)
    removed += carveSweep(bone, head, from, to, stepOf(1.0), tick).removed_mm3;
  EXPECT_GT(removed, 1.7 * volume_mm3(head));
  const Pose<Patient, Tool> middle{glm::angleAxis(glm::radians(25.0), glm::dvec3(1.0, 0.0, 0.0)), {}};
  EXPECT_LT(shapeOverlap(bone.field(), head, middle, {}).volume_mm3, 0.1 * volume_mm3(head));
}

TEST(CarveShape, RemovesNothingForWhatIsNoPose) {
  CarvedBone bone = block(2.0, 0.2).bone();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const BurShape& head : kShapes) {
    EXPECT_EQ(carveTool(bone, head, {{nan, 0.0, 0.0, 0.0}, {}}, stepOf(1.0), 0).removed_mm3, 0.0);
    EXPECT_EQ(carveTool(bone, head, {{1.0, 0.0, 0.0, 0.0}, {0.0, nan, 0.0}}, stepOf(1.0), 0).removed_mm3, 0.0);
    EXPECT_EQ(carveTool(bone, head, {{1.0, 0.0, 0.0, 0.0}, {1e300, 0.0, 0.0}}, stepOf(1.0), 0).removed_mm3, 0.0);
    EXPECT_EQ(carveTool(bone, head, kPose, stepOf(nan), 0).removed_mm3, 0.0);
  }
}

}  // namespace
}  // namespace haptics
