#include "app/calibrate/touch_round.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/arm/phantom_models.h"
#include "calibration/rig.h"

namespace {

using namespace app;
using calibration::Target;
using TouchEvent = TouchRound::TouchEvent;

/// A perfect arm where it should stand, and somebody who can put its tip anywhere.
struct Bench {
  calibration::MeasuredArm arm{calibration::kOmniGeometry, {}, calibration::mirroredWorkstationRig().X_WD};
  calibration::TargetPlan plan = *calibration::targetPlan("jig27");
  Announcements announcements;
  TouchRound round{plan, arm, 4.0, announcements};
  ButtonPress button;
  double t_s = 0.0;
  calibration::RawJoints raw_rad{};
  bool docked = false;

  /// The raw joints that bring the tip there.
  calibration::RawJoints at(const Target& target) const {
    const auto joints = calibration::jointsReaching(
        arm.geometry, arm.X_WD.inverse() * calibration::handleHolding(target, arm.correction.tip_H_mm));
    if (!joints) throw std::runtime_error("out of reach");
    return {joints->arm_rad.x,   joints->arm_rad.y,   joints->arm_rad.z,
            joints->wrist_rad.x, joints->wrist_rad.y, joints->wrist_rad.z};
  }
  /// Everything that happens in a while; `speed_rad_per_s` of the turret.
  std::vector<TouchEvent> wait(double seconds, bool down = false, double speed_rad_per_s = 0.0) {
    std::vector<TouchEvent> all;
    for (int i = 0; i < static_cast<int>(seconds * 1000.0); ++i) {
      t_s += 0.001;
      raw_rad[0] += 0.001 * speed_rad_per_s;
      StylusSample sample{t_s, raw_rad, arm.X_DH(raw_rad), down, true, docked};
      const Press press = button.update(t_s, down);
      const TouchEvent happened = round.update(sample, press, button.downAt_s());
      if (happened != TouchEvent::nothing) all.push_back(happened);
    }
    return all;
  }
  /// In one step: whoever jumps is not seen to move.
  void jump(const Target& target) { raw_rad = at(target); }
  /// Goes there and is taken by a press before holding still would take it.
  std::vector<TouchEvent> touch(const Target& target) {
    jump(target);
    wait(0.25);
    return press();
  }
  std::vector<TouchEvent> press(double seconds = 0.1) {
    auto all = wait(seconds, true);
    const auto rest = wait(0.05);
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
  }
  bool said(const char* words) const { return announcements.message.text.find(words) != std::string::npos; }
  std::size_t count() const { return round.touches().size(); }
};

TEST(TouchRound, TakesTargetsInTheirOrderByPress) {
  Bench bench;
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(bench.touch(bench.plan.targets[i]), std::vector{TouchEvent::taken}) << bench.announcements.message.text;
  const auto touches = bench.round.touches();
  ASSERT_EQ(touches.size(), 5u);
  EXPECT_EQ(touches[3].id, bench.plan.targets[3].id);
  EXPECT_LT(glm::length(bench.arm.tip_W(touches[3].joints_rad).mm - bench.plan.targets[3].position_W.mm), 1e-6);
}

TEST(TouchRound, TakesATargetByHoldingStillAndNotTwice) {
  Bench bench;
  bench.wait(0.1);
  bench.jump(bench.plan.targets[0]);
  EXPECT_EQ(bench.wait(3.0), std::vector{TouchEvent::taken});
  EXPECT_EQ(bench.count(), 1u);
}

TEST(TouchRound, HearsAPressInTheSameBreathAsTheSameTouch) {
  Bench bench;
  bench.wait(0.1);
  bench.jump(bench.plan.targets[0]);
  EXPECT_EQ(bench.wait(0.45), std::vector{TouchEvent::taken});
  EXPECT_TRUE(bench.press().empty());
  EXPECT_EQ(bench.announcements.message.tone, Tone::good);
}

TEST(TouchRound, RejectsAPressWhileMovingAndSaysSo) {
  Bench bench;
  bench.jump(bench.plan.targets[0]);
  bench.wait(0.3, false, 0.2);
  EXPECT_TRUE(bench.wait(0.1, true, 0.2).empty());
  bench.wait(0.05, false, 0.2);
  EXPECT_TRUE(bench.said("moving at")) << bench.announcements.message.text;
  EXPECT_EQ(bench.announcements.message.tone, Tone::reject);
  EXPECT_EQ(bench.count(), 0u);
}

TEST(TouchRound, UndoesTheLastByALongPress) {
  Bench bench;
  bench.touch(bench.plan.targets[0]);
  bench.touch(bench.plan.targets[1]);
  EXPECT_EQ(bench.press(1.0), std::vector{TouchEvent::undone});
  EXPECT_EQ(bench.count(), 1u);
  bench.touch(bench.plan.targets[0]);  // the second glows now
  EXPECT_EQ(bench.count(), 1u);
  EXPECT_EQ(bench.touch(bench.plan.targets[1]), std::vector{TouchEvent::taken});
}

TEST(TouchRound, ObjectsToTheWrongTiltAndTakesItWhenToldAgain) {
  Bench bench;
  Target wrong = bench.plan.targets[0];
  wrong.stylus_W.xyz = glm::normalize(wrong.stylus_W.xyz + glm::dvec3(0.4, 0.0, 0.0));
  EXPECT_TRUE(bench.touch(wrong).empty());
  EXPECT_TRUE(bench.said("to the left")) << bench.announcements.message.text;
  bench.wait(1.0);
  EXPECT_EQ(bench.press(), std::vector{TouchEvent::taken});
  EXPECT_EQ(bench.round.wronglyTilted(), std::vector<std::size_t>{0});
}

TEST(TouchRound, ObjectsToAnotherTargetAndNamesIt) {
  Bench bench;
  Target other = bench.plan.targets[4];
  other.stylus_W = bench.plan.targets[0].stylus_W;
  EXPECT_TRUE(bench.touch(other).empty());
  EXPECT_TRUE(bench.said("nearer to pit 5")) << bench.announcements.message.text;
}

TEST(TouchRound, NeverTakesTheSamePlaceTwice) {
  Bench bench;
  bench.touch(bench.plan.targets[0]);
  bench.wait(1.0);
  for (int n = 0; n < 3; ++n) {
    EXPECT_TRUE(bench.press().empty());
    EXPECT_TRUE(bench.said("where the last touch was")) << bench.announcements.message.text;
    bench.wait(1.0);
  }
}

TEST(TouchRound, PausesInTheInkwellAndGoesOnWhenTakenUp) {
  Bench bench;
  bench.touch(bench.plan.targets[0]);
  bench.docked = true;
  EXPECT_TRUE(bench.wait(5.0).empty());
  WizardView view;
  bench.round.show(view);
  EXPECT_EQ(view.choices.size(), 3u);
  EXPECT_EQ(bench.round.duration_s() < 2.0, true);
  bench.docked = false;
  bench.wait(0.1);
  EXPECT_EQ(bench.touch(bench.plan.targets[1]), std::vector{TouchEvent::taken});
}

TEST(TouchRound, IsLeftOrStartedAgainFromThePause) {
  Bench bench;
  bench.touch(bench.plan.targets[0]);
  bench.docked = true;
  bench.wait(0.1);
  bench.press();
  EXPECT_EQ(bench.press(1.0), std::vector{TouchEvent::started_again});
  EXPECT_EQ(bench.count(), 0u);
  bench.press();
  EXPECT_EQ(bench.press(1.0), std::vector{TouchEvent::left});
}

TEST(TouchRound, TellsProgressAndTimeLeftFromTheMedianOfTheTouches) {
  Bench bench;
  for (std::size_t i = 0; i < 3; ++i) {
    bench.touch(bench.plan.targets[i]);
    bench.wait(1.6 - (i == 2 ? 0.0 : 0.0));
  }
  WizardView view;
  bench.round.show(view);
  EXPECT_EQ(view.count, "3 of 27");
  EXPECT_NEAR(*view.progress, 3.0 / 27.0, 1e-12);
  EXPECT_NEAR(*view.time_left_s, 24.0 * 2.0, 24.0 * 0.2);
  EXPECT_EQ(view.targets[3].state, TargetState::next);
  EXPECT_EQ(view.targets[2].state, TargetState::done);
  EXPECT_EQ(view.targets[4].state, TargetState::pending);
}

TEST(TouchRound, CountsATouchThatIsMadeAgainOnce) {
  Bench bench;
  bench.touch(bench.plan.targets[0]);
  bench.touch(bench.plan.targets[1]);
  bench.round.again(0);
  WizardView view;
  bench.round.show(view);
  EXPECT_EQ(view.count, "1 of 27");
  EXPECT_EQ(view.targets[0].state, TargetState::next);
  EXPECT_EQ(bench.touch(bench.plan.targets[0]), std::vector{TouchEvent::taken}) << bench.announcements.message.text;
  EXPECT_EQ(bench.count(), 2u);
}

TEST(TouchRound, AsksForOneTouchAgainAfterASilence) {
  Bench bench;
  bench.touch(bench.plan.targets[0]);
  bench.touch(bench.plan.targets[1]);
  bench.round.lost();
  WizardView view;
  bench.round.show(view);
  EXPECT_EQ(view.targets[1].state, TargetState::next);
  bench.t_s += 10.0;
  bench.wait(0.5);
  EXPECT_TRUE(bench.touch(bench.plan.targets[1]).empty());
  EXPECT_TRUE(bench.said("zero of the device is unchanged")) << bench.announcements.message.text;
  EXPECT_EQ(bench.count(), 2u);
}

}  // namespace
