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

/// The second molar is a ball that stands nearer to the viewer than the flat bone, 4 mm beside the cut.
TEST(StartPose, LiesBesideTheLineWhereAnotherToothWouldBeNearest) {
  const render::Frame frame = turnedPatient();
  const auto X_PW = frame.rig.X_WP.inverse();
  const auto inP = [&](const glm::dvec3& p_W_mm) { return (X_PW * calibration::Point<calibration::World>{p_W_mm}).mm; };
  const glm::dvec3 molar_W_mm{4.0, 0.0, 2.0};
  const double molar_mm = 4.0;
  const GapOf gap_of = [&](const render::Frame& moved) -> std::optional<render::BoneGap> {
    const glm::dvec3 at = (moved.rig.X_WP * Point<Patient>{moved.X_PT.translation_mm}).mm;
    const double flat_mm = at.z - moved.bur_radius_mm, ball_mm = glm::distance(at, molar_W_mm) - molar_mm - 1.5;
    if (std::min(flat_mm, ball_mm) > render::kMaxGap_mm) return {};
    if (flat_mm < ball_mm) return render::BoneGap{std::max(flat_mm, 0.0), {inP({at.x, at.y, 0.0})}};
    return render::BoneGap{std::max(ball_mm, 0.0), {inP(molar_W_mm + molar_mm * glm::normalize(at - molar_W_mm))}};
  };
  assets::PlannedCut cut;
  cut.surface_P_mm = inP({0.0, 0.0, 0.0});
  for (const double x_mm : {-6.0, -4.0, -2.0, 0.0})
    cut.strokes_P_mm.push_back({inP({x_mm, -2.0, 0.0}), inP({x_mm, 2.0, 0.0})});
  const auto nearestAt = [&](const glm::dvec3& start_W_mm) {
    render::Frame moved = frame;
    moved.X_PT.translation_mm = inP(start_W_mm);
    return gap_of(moved).value();
  };
  const glm::dvec3 straight = startBeforeBone(frame, cut.surface_P_mm, gap_of).value();
  EXPECT_LT(glm::distance(nearestAt(straight).nearest_P.mm, inP(molar_W_mm)), molar_mm + 1e-6) << "the molar";
  const glm::dvec3 beside = startBeforePlan(frame, cut, gap_of).value();
  const render::BoneGap gap = nearestAt(beside);
  EXPECT_NEAR(gap.mm, kStartGap_mm, 1e-9);
  EXPECT_GT(glm::distance(gap.nearest_P.mm, inP(molar_W_mm)), molar_mm + 0.1) << "the cut";
  EXPECT_LE(glm::length(glm::dvec2(beside)), 8.0 + 1e-9);
}

TEST(StartPose, IsNotKnownWhereNoBoneIsNear) { EXPECT_FALSE(startBeforeBone(turnedPatient(), {}, boneAt(-1000.0))); }

TEST(StartPose, IsFiveMillimetresOverTheHighestCuspAboveTheChambersMiddle) {
  assets::ToothCanals tooth;
  tooth.frame.cervix_P_mm = {10.0, 20.0, 30.0};
  // Occlusal is y of P.
  tooth.frame.axes_P = glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  tooth.chamber.outline_mm = {{-1.0, 1.0}, {3.0, 1.0}};
  for (const double cusp_mm : {6.0, 7.5}) {
    assets::ToothCanal canal;
    canal.reference_P_mm = tooth.frame.inP({2.0, 3.0, cusp_mm});
    tooth.canals.push_back(canal);
  }
  EXPECT_LT(glm::distance(startOverCrown_P_mm(tooth), glm::dvec3(11.0, 32.5, 31.0)), 1e-12);
}

}  // namespace
}  // namespace app
