// One page after the other: what every step of the calibration is given and what it answers. Plain logic; one thread.
#pragma once

#include <memory>
#include <string>

#include "app/calibrate/announcements.h"
#include "app/calibrate/button_press.h"
#include "app/calibrate/stylus_sample.h"
#include "app/calibrate/wizard_outcome.h"
#include "app/calibrate/wizard_view.h"

namespace app {

/// What all steps write into.
struct WizardBook {
  WizardPlan plan;
  WizardOutcome outcome;
  Announcements voice;
  calibration::MeasuredArm arm;  ///< as it is believed by now
  bool arm_is_measured = false;  ///< else: as its model, where it was put down

  bool byEyes() const { return plan.method.starts_with("visual"); }
  /// Beyond which a touch can not be of its target.
  double far_mm() const { return !arm_is_measured ? 0.0 : byEyes() ? 5.0 : 4.0; }
};

enum class StepName {
  identity,
  home,
  flip,
  length,
  eyes,
  collect,
  fit,
  eye_check,
  verify,
  check,
  rezero,
  rest,
  sign_off
};

struct StepAnswer {
  enum class Kind { stay, next, go_to, end } kind = Kind::stay;
  StepName to = StepName::sign_off;  ///< of go_to
  WizardOutcome::End end = WizardOutcome::End::running;
  std::string reason;

  static StepAnswer next() { return {Kind::next, StepName::sign_off, WizardOutcome::End::running, {}}; }
  static StepAnswer goTo(StepName name) { return {Kind::go_to, name, WizardOutcome::End::running, {}}; }
  static StepAnswer refused(std::string why) {
    return {Kind::end, StepName::sign_off, WizardOutcome::End::refused, std::move(why)};
  }
  static StepAnswer declined() {
    return {Kind::end, StepName::sign_off, WizardOutcome::End::declined, "Left: the old calibration stays."};
  }
  static StepAnswer accepted(std::string words) {
    return {Kind::end, StepName::sign_off, WizardOutcome::End::accepted, std::move(words)};
  }
};

class WizardStep {
 public:
  /// Borrows the book.
  explicit WizardStep(WizardBook& book) : book_(book) {}
  virtual ~WizardStep() = default;
  /// Every time its page is turned to.
  virtual void begin() = 0;
  /// `pressed_s`: when the button went down.
  virtual StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) = 0;
  /// The device was silent, and is not any more.
  virtual void lost() {}
  /// False: it can be read and answered without a device that is calibrated.
  virtual bool needsDevice() const { return true; }
  virtual void show(WizardView& view) const = 0;

 protected:
  WizardBook& book_;
};

/// A touch set of the plan's device, ready for its touches.
calibration::TouchSet emptySet(const WizardBook& book, const calibration::TargetPlan& plan);

using StepMaker = std::unique_ptr<WizardStep>(WizardBook& book);
StepMaker identityStep, homeStep, flipStep, lengthStep, eyesStep, collectStep, fitStep, eyeCheckStep, verifyStep,
    checkStep, rezeroStep, restStep, signOffStep;

}  // namespace app
