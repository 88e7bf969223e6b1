// A whole calibration by the mouse: events as a window reports them, in virtual time, through the practice stylus and
// its arm with errors, to the verdict.
#include "app/calibrate/practice_input.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/calibrate/stylus_source.h"
#include "app/calibrate/wizard.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr glm::dvec3 kAcross_W{0.25, 0.0, 0.0}, kUp_W{0.0, 0.25, 0.0}, kStart_mm{0.0, 20.0, 30.0};

/// A person who reads the pages and has only a mouse with three buttons and a wheel.
class MousePerson {
 public:
  explicit MousePerson(PracticeInput& input) : input_(input) {}

  void act(const WizardView& view, double t_s) {
    if (down_ && t_s >= release_s_) button(down_ = false, t_s);
    if (down_ || t_s < next_s_) return;
    if (view.inkwell != in_inkwell_) {
      middle(true), middle(false);
      in_inkwell_ = view.inkwell;
      next_s_ = t_s + 1.0;
      return;
    }
    if (view.marked) {
      press(t_s, wanted(view) == *view.marked ? 1.0 : 0.15);
      return;
    }
    for (const ShownTarget& target : view.targets)
      if (target.state == TargetState::next && view.choices.empty()) touch(view, target, t_s);
  }

 private:
  static std::size_t wanted(const WizardView& view) {
    if (!view.value.empty()) return 2;  // as it is shown
    for (std::size_t n = 0; n < view.choices.size(); ++n)
      for (const char* good : {"take it", "done", "go on"})
        if (view.choices[n].starts_with(good)) return n;
    return 0;
  }

  void touch(const WizardView& view, const ShownTarget& target, double t_s) {
    const std::string now = view.title + target.name;
    if (now != at_) {
      at_ = now;
      moveTo(target);
      next_s_ = t_s + 1.0;
      return;
    }
    press(t_s, 0.15);
    at_.clear();  // a rejected touch is approached again
  }

  void moveTo(const ShownTarget& target) {
    const glm::dvec3 by = target.position_W.mm - tip_mm_;
    send(render::PointerMoved{.by_px = {by.x / 0.25, -by.y / 0.25}, .button = render::MouseButton::left});
    const double notches = -std::round(by.z);
    send(render::WheelTurned{notches});
    tip_mm_ += glm::dvec3(by.x, by.y, -notches);
    // Two rotations at a time converge for leaning styluses.
    const double per_px = calibration::radFromDegrees(0.3);
    const glm::dvec3 wanted = target.stylus_W.xyz;
    middle(true);
    for (int n = 0; n < 8; ++n) {
      const double yaw = std::atan2(wanted.x, wanted.z) - std::atan2(along_.x, along_.z);
      along_ = glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * along_;
      const double pitch = std::atan2(along_.y, along_.z) - std::atan2(wanted.y, wanted.z);
      along_ = glm::angleAxis(pitch, glm::dvec3(1, 0, 0)) * along_;
      send(render::PointerMoved{.by_px = {yaw / per_px, pitch / per_px}, .button = render::MouseButton::middle});
    }
    middle(false);
  }

  void press(double t_s, double seconds) {
    button(down_ = true, t_s);
    release_s_ = t_s + seconds;
    next_s_ = release_s_ + 1.3;
  }
  void button(bool down, double) { send(render::ButtonPressed{render::MouseButton::right, down}); }
  void middle(bool down) { send(render::ButtonPressed{render::MouseButton::middle, down}); }
  void send(const render::WindowEvent& event) { input_.take(event, kAcross_W, kUp_W); }

  PracticeInput& input_;
  glm::dvec3 tip_mm_ = kStart_mm, along_ = calibration::kRestingStylus_W.xyz;
  std::string at_;
  bool in_inkwell_ = false, down_ = false;
  double release_s_ = 0.0, next_s_ = 0.5;
};

TEST(PracticeInput, AMouseAloneLeadsAWholeCalibrationToAGoodVerdict) {
  calibration::SyntheticRig rig = calibration::syntheticRig(calibration::Scenario::d, 7);
  WizardPlan plan;
  plan.procedure = CalibrationProcedure::full;
  plan.method = "jig8";
  plan.record.rig = calibration::desktopRig({1920, 1080});
  plan.record.rig.device = rig.nominal.device;
  plan.record.rig.X_WD = rig.nominal.X_WD;
  plan.device = *rig.nominal.device;
  plan.settle_s = 1.0;
  Wizard wizard(plan);
  PracticeStylus stylus(rig, {.tip_W = {kStart_mm}});
  PracticeInput input({.tip_W = {kStart_mm}}, 7);
  MousePerson person(input);
  WizardView view = wizard.takeView();
  double t_s = 0.0;
  std::string pages;
  for (int tick = 0; tick < 400'000 && !wizard.isOver(); ++tick) {
    t_s = 1e-3 * tick;
    if (tick % 25 == 0) {
      view = wizard.takeView();
      if (!pages.ends_with(view.title + "\n")) pages += view.title + "\n";
      EXPECT_EQ(view.sentence.find("mirror"), std::string::npos) << "there is none: " << view.sentence;
      person.act(view, t_s);
      stylus.setPose(input.pose(view));
    }
    wizard.update(sampleOf({.t_s = t_s, .state = stylus.exchange({}, 1e-3)}));
  }
  ASSERT_TRUE(wizard.isOver()) << pages << view.sentence << "\n" << view.message.text;
  EXPECT_EQ(wizard.outcome().end, WizardOutcome::End::accepted) << pages << wizard.outcome().reason;
  ASSERT_TRUE(wizard.outcome().errors);
  EXPECT_LT(wizard.outcome().errors->rms_mm, 1.0);
  for (const char* page : {"Does the F read right?", "How far is the eye from the screen?", "Bring the device home"})
    EXPECT_NE(pages.find(page), std::string::npos) << pages;
}

TEST(PracticeInput, AMiddleDragTiltsAndAMiddleClickDocks) {
  PracticeInput input({.tip_W = {kStart_mm}}, 1);
  const auto send = [&](const render::WindowEvent& event) { input.take(event, kAcross_W, kUp_W); };
  const glm::dvec3 before = input.pose({}).along_W.xyz;
  send(render::ButtonPressed{render::MouseButton::middle, true});
  send(render::PointerMoved{.by_px = {100.0, 0.0}, .button = render::MouseButton::middle});
  send(render::ButtonPressed{render::MouseButton::middle, false});
  EXPECT_FALSE(input.pose({}).in_inkwell);
  EXPECT_LT(glm::dot(before, input.pose({}).along_W.xyz), 0.98);
  EXPECT_EQ(input.pose({}).tip_W.mm, kStart_mm);
  send(render::ButtonPressed{render::MouseButton::middle, true});
  send(render::ButtonPressed{render::MouseButton::middle, false});
  EXPECT_TRUE(input.pose({}).in_inkwell);
  send(render::ButtonPressed{render::MouseButton::right, true});
  EXPECT_TRUE(input.pose({}).button);
  send(render::ButtonPressed{render::MouseButton::right, false});
  for (int n = 0; n < 3; ++n) input.pose({});
  EXPECT_FALSE(input.pose({}).button);
}

TEST(PracticeInput, ATapBetweenTwoFramesIsAPress) {
  for (const bool by_key : {false, true}) {
    PracticeInput input({}, 1);
    const auto event = [&](bool down) {
      render::WindowEvent happened = render::ButtonPressed{render::MouseButton::right, down};
      if (by_key) happened = render::KeyPressed{.key = render::Key::space, .down = down};
      input.take(happened, kAcross_W, kUp_W);
    };
    event(true), event(false);
    int pressed = 0;
    while (pressed < 100 && input.pose({}).button) ++pressed;
    EXPECT_EQ(pressed, 3);
    // A long press ends with its release.
    event(true);
    for (int n = 0; n < 50; ++n) EXPECT_TRUE(input.pose({}).button);
    event(false);
    EXPECT_FALSE(input.pose({}).button);
  }
}

}  // namespace
}  // namespace app
