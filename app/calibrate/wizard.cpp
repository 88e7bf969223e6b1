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

/// The device as it is believed to stand before anything is measured.
calibration::MeasuredArm armOf(const WizardPlan& plan) {
  if (plan.procedure != CalibrationProcedure::full)
    if (const auto measured = calibration::measuredArm(plan.record.rig)) return *measured;
  const calibration::PhantomModel* const model = calibration::findPhantomModel(plan.device.model);
  if (model == nullptr)
    throw calibration::CalibrationError("calibration: no arm is known for a device \"" + plan.device.model +
                                        "\": use one of omni, touch, desktop, premium");
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
  book_.plan = std::move(plan);
  book_.arm = armOf(book_.plan);
  book_.arm_is_measured = book_.plan.procedure != CalibrationProcedure::full && book_.plan.record.rig.arm.has_value();
  for (const StepName name : pagesOf(book_.plan.procedure))
    steps_.emplace_back(name, kSteps[static_cast<std::size_t>(name)](book_));
  turnTo(0);
}

void Wizard::feel(const StylusSample& sample) {
  if (isOver()) return;
  // A device that was silent is told of once it is there again.
  if (sample.believable) {
    if (lost_) step().lost();
    lost_ = false;
    believed_s_ = sample.t_s;
  } else if (step().needsDevice()) {
    if (!believed_s_) believed_s_ = sample.t_s;
    if (!lost_ && sample.t_s - *believed_s_ > kLost_s) {
      lost_ = true;
      ++book_.outcome.silences;
      button_.forget();
      book_.voice.refuse("The device has fallen silent.");
    }
    return;
  }
  const Press press = button_.feel(sample.t_s, sample.button);
  obey(step().feel(sample, press, button_.downAt_s()));
}

void Wizard::turnTo(std::size_t page) {
  // What was said on this page is still to be read on the next one, what was said before it is not.
  if (book_.voice.message.text == said_before_) book_.voice.message = {};
  said_before_ = book_.voice.message.text;
  at_ = page;
  step().begin();
}

void Wizard::obey(const StepAnswer& answer) {
  if (answer.next_page) return turnTo(at_ + 1);
  if (answer.page) {
    const auto page = std::ranges::find(steps_, *answer.page, &Page::first);
    if (page != steps_.end()) turnTo(static_cast<std::size_t>(page - steps_.begin()));
    return;
  }
  if (answer.end == WizardOutcome::End::running) return;
  book_.outcome.end = answer.end;
  book_.outcome.reason = answer.reason;
  book_.voice.message = {};
  book_.voice.sounds.push_back(answer.end == WizardOutcome::End::accepted ? WizardSound::done : WizardSound::reject);
}

WizardView Wizard::look() {
  WizardView view;
  const calibration::Rig rig = rigSoFar(book_.plan.record.rig, book_.outcome);
  view.screen = rig.screen;
  view.left_eye = rig.left_eye;
  view.right_eye = rig.right_eye;
  view.message = book_.voice.message;
  view.sounds = std::exchange(book_.voice.sounds, {});

  if (isOver()) {
    view.title = book_.outcome.end == WizardOutcome::End::accepted ? "Taken" : "Nothing is changed";
    view.sentence = book_.outcome.reason;
    return view;
  }
  step().show(view);
  if (!lost_) return view;
  // Nothing on the page can be done now.
  view.title = "The device is silent";
  view.sentence = "See to its cable and its lights. What was touched is kept.";
  view.button = {};
  view.choices.clear();
  view.marked.reset();
  view.tip_W.reset();
  view.tilt.reset();
  view.capture = 0.0;
  return view;
}

}  // namespace app
