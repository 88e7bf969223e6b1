// The scripted hand: what interrupts it, its tray, and the ways that it is led.

#include "app/procedure/third_molar/demonstration.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "app/procedure/third_molar/delivery_path.h"
#include "app/text/usage_error.h"
#include "haptics/device/simulated/trough_path.h"
#include "tests/app/procedure/third_molar_phantom.h"

namespace app {
namespace {

/// The phantom's operation at its first cut.
struct Shown {
  assets::Patient patient = phantom(3.0);
  haptics::Bodies bodies{patient.ct.grid, patient.ct.solid, patient.ct.label, assets::voxelsOfTooth(patient.ct, kFdi)};
  std::vector<haptics::Tool> tray{{{haptics::ShapeKind::sphere, 1.5, 0.0}, {}},
                                  {{haptics::ShapeKind::capsule, 1.0, 8.0}, {}},
                                  haptics::forcepsTool()};
  assets::PlannedCut gutter = assets::plannedAlong({{-5.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}});
  haptics::LedHand hand{{}};
  Demonstration demonstration{Demonstration::Site{patient, gutter, tray, bodies, hand}};

  Demonstration::Frame frame() const {
    Demonstration::Frame one;
    one.newest.dt_s = 1e-3;
    one.newest.state = haptics::SafetyState::active;
    one.in_hand = tray[0];
    one.is_applied = true;
    return one;
  }
};

TEST(Demonstration, SaysWhatInterruptedIt) {
  const auto after = [](const auto& change) {
    Shown shown;
    Demonstration::Frame frame = shown.frame();
    EXPECT_FALSE(shown.demonstration.follow(frame));
    EXPECT_FALSE(shown.demonstration.isOver());
    change(frame);
    EXPECT_FALSE(shown.demonstration.follow(frame));
    EXPECT_EQ(shown.demonstration.isOver(), !shown.demonstration.failure().empty());
    return shown.demonstration.failure();
  };
  EXPECT_EQ(after([](Demonstration::Frame&) {}), "");
  EXPECT_EQ(after([](Demonstration::Frame& frame) { frame.in_hand = haptics::forcepsTool(); }),
            "another tool was taken");
  EXPECT_EQ(after([](Demonstration::Frame& frame) { frame.drill_enabled = false; }), "the drill was locked");
  EXPECT_EQ(after([](Demonstration::Frame& frame) { frame.newest.state = haptics::SafetyState::fault; }),
            "the motors are off");
}

TEST(Demonstration, NeedsALongBurAndForceps) {
  const haptics::Tool ball{{haptics::ShapeKind::sphere, 1.5, 0.0}, {}},
      stub{{haptics::ShapeKind::capsule, 1.0, 0.1}, {}}, bur{{haptics::ShapeKind::capsule, 1.0, 8.0}, {}};
  EXPECT_THROW(operationTray({ball, haptics::forcepsTool()}), UsageError);
  EXPECT_THROW(operationTray({ball, stub, haptics::forcepsTool()}), UsageError);
  EXPECT_THROW(operationTray({ball, bur}), UsageError);
  EXPECT_EQ(operationTray({ball, bur, haptics::forcepsTool()}).forceps, 2U);
  EXPECT_FALSE(operationTray({ball, bur, haptics::forcepsTool()}).elevator);
  const haptics::Tool cryer = haptics::elevatorTool(haptics::ElevatorKind::cryer_left),
                      straight = haptics::elevatorTool(haptics::ElevatorKind::straight_301);
  EXPECT_EQ(operationTray({ball, bur, cryer, straight, haptics::forcepsTool()}).elevator, 3U);
}

TEST(DeliveryPath, LeadsTheToolAsThePieceGoesAndLaysItDownOutside) {
  DeliveryStep step;
  step.out_P = {0.0, 0.0, 1.0};
  for (int n = 0; n <= 4; ++n)
    step.path_X_PQ.push_back({glm::angleAxis(0.1 * n, glm::dvec3(1.0, 0.0, 0.0)), {0.0, 0.5 * n, 3.0 * n}});
  const HandPose hand{glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0)), {1.0, 2.0, 3.0}};
  const glm::dvec3 outside_P_mm(0.0, 10.0, 60.0), laid_P_mm(0.0, -30.0, 60.0);
  const haptics::LedPath path = takeOut(hand, {}, step, outside_P_mm, laid_P_mm);
  const haptics::HandTarget first = path.script(0.0), end = path.script(path.duration_s);
  EXPECT_LT(glm::distance(first.position_mm, hand.translation_mm), 1e-9);
  EXPECT_LT(glm::distance(end.position_mm, laid_P_mm), 1e-9);
  EXPECT_FALSE(end.pedal);
  const HandPose out = step.path_X_PQ.back() * (haptics::PiecePose{}.inverse() * hand);
  double fastest_in_mouth_mm_per_s = 0.0;
  bool was_beyond = false, was_outside = false;
  for (double t_s = 0.0; t_s < path.duration_s; t_s += 0.001) {
    const haptics::HandTarget at = path.script(t_s);
    if (at.pedal)
      was_outside = was_outside || glm::distance(at.position_mm, outside_P_mm) < 0.5;
    else
      EXPECT_LT(glm::distance(at.position_mm, laid_P_mm), 1e-9) << "opened where it lies";
    const bool is_beyond = glm::dot(at.position_mm - out.translation_mm, step.out_P) > 9.99;
    was_beyond = was_beyond || is_beyond;
    if (!was_beyond)
      fastest_in_mouth_mm_per_s = std::max(fastest_in_mouth_mm_per_s,
                                           glm::distance(at.position_mm, path.script(t_s + 0.001).position_mm) / 0.001);
  }
  EXPECT_TRUE(was_beyond) << "along the way out to its end";
  EXPECT_TRUE(was_outside) << "through the mouth's opening";
  EXPECT_LT(fastest_in_mouth_mm_per_s, 30.0);
}

TEST(DeliveryPath, TwistsAnElevatorToBothSidesInTheSlot) {
  SplitStep step;
  step.tip_P_mm = {1.0, 2.0, 3.0};
  step.along_P = {0.0, 1.0, 0.0};
  const haptics::LedPath path = twistInSlot({{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 30.0}}, {0.0, 0.0, 60.0}, step);
  const glm::dquat straight = path.script(path.duration_s).rotation;
  EXPECT_LT(glm::distance(straight * glm::dvec3(1.0, 0.0, 0.0), step.along_P), 1e-9) << "the blade's width";
  EXPECT_LT(glm::distance(straight * glm::dvec3(0.0, 0.0, 1.0), step.out_P), 1e-9) << "the shaft";
  EXPECT_GT(path.script(path.duration_s).position_mm.z, 15.0) << "up again";
  double least_rad = 0.0, most_rad = 0.0;
  for (double t_s = 0.0; t_s < path.duration_s; t_s += 0.01) {
    const haptics::HandTarget target = path.script(t_s);
    EXPECT_FALSE(target.pedal);
    if (glm::distance(target.position_mm, step.tip_P_mm) > 1e-6) continue;
    const glm::dquat turn = glm::conjugate(straight) * target.rotation;
    EXPECT_LT(std::hypot(turn.x, turn.y), 1e-9) << "about the shaft";
    const double twist_rad = 2.0 * std::atan2(turn.z, turn.w);
    least_rad = std::min(least_rad, twist_rad);
    most_rad = std::max(most_rad, twist_rad);
  }
  EXPECT_NEAR(most_rad, 1.0, 0.01);
  EXPECT_NEAR(least_rad, -1.0, 0.01);
}

TEST(DeliveryPath, GripsBeforeItRocksAndRocksToBothSides) {
  DeliveryStep step;
  step.grip_P_mm = {0.0, 0.0, 5.0};
  step.rock_axis_P = {0.0, 1.0, 0.0};
  const glm::dquat held(1.0, 0.0, 0.0, 0.0);
  const haptics::LedPath path = gripAndRock({held, {0.0, 0.0, 40.0}}, {0.0, 0.0, 60.0}, step, held);
  const double rocks_from_s = path.duration_s - kRocks_s;
  EXPECT_FALSE(path.script(0.5 * rocks_from_s).pedal);
  EXPECT_TRUE(path.script(rocks_from_s - 0.1).pedal);
  EXPECT_TRUE(path.script(rocks_from_s).pedal);
  EXPECT_LT(glm::distance(path.script(rocks_from_s).position_mm, step.grip_P_mm), 1e-6);
  double least = 1.0, most = -1.0;
  for (double t_s = rocks_from_s; t_s < path.duration_s; t_s += 0.01) {
    least = std::min(least, path.script(t_s).rotation.y);
    most = std::max(most, path.script(t_s).rotation.y);
  }
  EXPECT_NEAR(most, -least, 0.02);
  EXPECT_GT(most, 0.15);
}

}  // namespace
}  // namespace app
