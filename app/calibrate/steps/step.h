// The steps of the calibration: their shared context and their results. Plain logic; one thread.
#pragma once

#include <memory>
#include <string>

#include "app/calibrate/announcements.h"
#include "app/calibrate/button_press.h"
#include "app/calibrate/stylus_sample.h"
#include "app/calibrate/wizard_outcome.h"
#include "app/calibrate/wizard_view.h"

namespace app {

/// Shared by all steps.
struct WizardContext {
  WizardPlan plan;
  WizardOutcome outcome;
  Announcements announcements;
  calibration::MeasuredArm arm;  ///< current estimate
  bool arm_is_measured = false;  ///< else: as its model, where it was put down

  bool byEyes() const { return plan.method.starts_with("visual"); }
  /// Beyond which a touch cannot be of its target.
  double max_distance_mm() const { return !arm_is_measured ? 0.0 : byEyes() ? 5.0 : 4.0; }
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

/// Result of an update; by default the page stays.
struct StepResult {
  bool next_page = false;
  std::optional<StepName> page{};  ///< to go to
  WizardOutcome::End end = WizardOutcome::End::running;
  std::string reason{};

  static StepResult next() { return {.next_page = true}; }
  static StepResult goTo(StepName name) { return {.page = name}; }
  static StepResult refused(std::string why) { return {.end = WizardOutcome::End::refused, .reason = std::move(why)}; }
  static StepResult declined() {
    return {.end = WizardOutcome::End::declined, .reason = "Left: the old calibration stays."};
  }
  static StepResult accepted(std::string words) {
    return {.end = WizardOutcome::End::accepted, .reason = std::move(words)};
  }
};

class WizardStep {
 public:
  explicit WizardStep(WizardContext& context) : context_(context) {}
  virtual ~WizardStep() = default;
  /// Called whenever its page is entered.
  virtual void begin() = 0;
  /// `pressed_s`: time of the press.
  virtual StepResult update(const StylusSample& sample, Press press, double pressed_s) = 0;
  /// Called after the device was silent and has returned.
  virtual void lost() {}
  /// False: works without a calibrated device.
  virtual bool needsDevice() const { return true; }
  virtual void show(WizardView& view) const = 0;

 protected:
  WizardContext& context_;
};

/// A touch set of the plan's device without touches.
calibration::TouchSet emptySet(const WizardContext& context, const calibration::TargetPlan& plan);

using StepMaker = std::unique_ptr<WizardStep>(WizardContext& context);
StepMaker identityStep, homeStep, flipStep, lengthStep, eyesStep, collectStep, fitStep, eyeCheckStep, verifyStep,
    checkStep, rezeroStep, restStep, signOffStep;

}  // namespace app
