#include "app/rehearsal/start_pose.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using calibration::Patient;
using calibration::Point;

render::Frame turnedPatient() {
  render::Frame frame;
  frame.rig.X_WP = {glm::angleAxis(0.9, glm::normalize(glm::dvec3(3, 1, 2))), {5.0, -2.0, 1.0}};
  frame.bur_radius_mm = 1.5;
  return frame;
}

/// Flat bone, `z_mm` in W; the bur is a ball.
GapOf boneAt(double z_mm) {
  return [z_mm](const render::Frame& frame) -> std::optional<render::BoneGap> {
    const double gap_mm =
        (frame.rig.X_WP * Point<Patient>{frame.X_PT.translation_mm}).mm.z - z_mm - frame.bur_radius_mm;
    if (gap_mm > render::kMaxGap_mm) return {};
    return render::BoneGap{std::max(gap_mm, 0.0), {}};
  };
}

TEST(StartPose, IsFiveMillimetresBeforeTheBoneOnTheLineThroughTheGoal) {
  const render::Frame frame = turnedPatient();
  const glm::dvec3 goal_P_mm{1.0, 2.0, 3.0};
  const glm::dvec3 goal_W_mm = (frame.rig.X_WP * Point<Patient>{goal_P_mm}).mm;
  for (const double bone_mm : {-3.0, 0.0, 12.0}) {
    const auto start_W_mm = startBeforeBone(frame, goal_P_mm, boneAt(goal_W_mm.z + bone_mm));
    ASSERT_TRUE(start_W_mm);
    EXPECT_NEAR(start_W_mm->x, goal_W_mm.x, 1e-9);
    EXPECT_NEAR(start_W_mm->y, goal_W_mm.y, 1e-9);
    EXPECT_NEAR(start_W_mm->z, goal_W_mm.z + bone_mm + frame.bur_radius_mm + kStartGap_mm, 1e-9);
  }
}

TEST(StartPose, IsNotKnownWhereNoBoneIsNear) { EXPECT_FALSE(startBeforeBone(turnedPatient(), {}, boneAt(-1000.0))); }

}  // namespace
}  // namespace app
