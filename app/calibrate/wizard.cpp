#include "app/calibrate/wizard.h"

#include <algorithm>
#include <array>

#include "calibration/arm/phantom_models.h"

namespace app {
namespace {

constexpr double kLost_s = 0.3;

std::vector<StepName> pagesOf(CalibrationProcedure procedure) {
  using enum StepName;
  switch (procedure) {
    case CalibrationProcedure::full:
      return {identity, home, flip, length, eyes, collect, fit, eye_check, verify, sign_off};
    case CalibrationProcedure::check:
      return {identity, home, check, rezero, sign_off};
    case CalibrationProcedure::rezero:
      return {identity, home, rezero, check, sign_off};
    case CalibrationProcedure::rest:
      return {identity, home, rest, sign_off};
  }
  return {};
}

/// The arm before anything is measured.
calibration::MeasuredArm armOf(const WizardPlan& plan) {
  if (plan.procedure != CalibrationProcedure::full)
    if (const auto measured = calibration::measuredArm(plan.record.rig)) return *measured;
  const calibration::PhantomModel* const model = calibration::findPhantomModel(plan.device.model);
  if (model == nullptr)
    throw calibration::CalibrationError("calibration: no arm is known for a device \"" + plan.device.model +
                                        "\": use one of " + calibration::phantomModelKeys());
  return {model->geometry, {}, plan.record.rig.X_WD};
}

/// In the order of StepName.
constexpr std::array kSteps = {identityStep, homeStep,   flipStep,  lengthStep, eyesStep, collectStep, fitStep,
                               eyeCheckStep, verifyStep, checkStep, rezeroStep, restStep, signOffStep};

}  // namespace

Wizard::Wizard(WizardPlan plan) {
  if (plan.procedure == CalibrationProcedure::full && !calibration::targetPlan(plan.method, plan.jig))
    throw calibration::CalibrationError("calibration: no method \"" + plan.method +
                                        "\": use one of jig27, jig8, visual15, visual25");
  context_.plan = std::move(plan);
  context_.arm = armOf(context_.plan);
  context_.arm_is_measured =
      context_.plan.procedure != CalibrationProcedure::full && context_.plan.record.rig.arm.has_value();
  for (const StepName name : pagesOf(context_.plan.procedure))
    steps_.emplace_back(name, kSteps[static_cast<std::size_t>(name)](context_));
  turnTo(0);
}

void Wizard::update(const StylusSample& sample) {
  if (isOver()) return;
  // The step is informed when the device is back.
  if (sample.valid) {
    if (lost_) step().lost();
    lost_ = false;
    valid_s_ = sample.t_s;
  } else if (step().needsDevice()) {
    if (!valid_s_) valid_s_ = sample.t_s;
    if (!lost_ && sample.t_s - *valid_s_ > kLost_s) {
      lost_ = true;
      ++context_.outcome.silences;
      button_.forget();
      context_.announcements.refuse("The device sends no data.");
    }
    return;
  }
  const Press press = button_.update(sample.t_s, sample.button);
  apply(step().update(sample, press, button_.downAt_s()));
}

void Wizard::turnTo(std::size_t page) {
  // A message of this page stays for the next page, an older one is cleared.
  if (context_.announcements.message.text == said_before_) context_.announcements.message = {};
  said_before_ = context_.announcements.message.text;
  at_ = page;
  step().begin();
}

void Wizard::apply(const StepResult& answer) {
  if (answer.next_page) return turnTo(at_ + 1);
  if (answer.page) {
    const auto page = std::ranges::find(steps_, *answer.page, &Page::first);
    if (page != steps_.end()) turnTo(static_cast<std::size_t>(page - steps_.begin()));
    return;
  }
  if (answer.end == WizardOutcome::End::running) return;
  context_.outcome.end = answer.end;
  context_.outcome.reason = answer.reason;
  context_.announcements.message = {};
  context_.announcements.sounds.push_back(answer.end == WizardOutcome::End::accepted ? WizardSound::done
                                                                                     : WizardSound::reject);
}

WizardView Wizard::takeView() {
  WizardView view;
  const calibration::Rig rig = rigSoFar(context_.plan.record.rig, context_.outcome);
  view.screen = rig.screen;
  view.left_eye = rig.left_eye;
  view.right_eye = rig.right_eye;
  view.message = context_.announcements.message;
  view.sounds = std::exchange(context_.announcements.sounds, {});

  if (isOver()) {
    view.title = context_.outcome.end == WizardOutcome::End::accepted ? "Taken" : "Nothing is changed";
    view.sentence = context_.outcome.reason;
    return view;
  }
  step().show(view);
  if (!lost_) return view;
  view.title = "The device is silent";
  view.sentence = "Check its cable and its lights. The touches are kept.";
  view.button = {};
  view.choices.clear();
  view.marked.reset();
  view.tip_W.reset();
  view.tilt.reset();
  view.capture = 0.0;
  return view;
}

}  // namespace app
