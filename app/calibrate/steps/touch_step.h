// A step that is one round of touches. Plain logic; one thread.
#pragma once

#include <optional>

#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {

class TouchStep : public WizardStep {
 public:
  using WizardStep::WizardStep;
  StepResult update(const StylusSample& sample, Press press, double pressed_s) override {
    if (round_->update(sample, press, pressed_s) == TouchRound::TouchEvent::left) return StepResult::declined();
    if (!round_->isComplete()) return {};
    try {
      return completed();
    } catch (const calibration::CalibrationError& error) {
      begin();
      context_.announcements.refuse(error.what());
      return {};
    }
  }
  void lost() override { round_->lost(); }

 protected:
  /// Called once all targets are touched; a CalibrationError starts the step again.
  virtual StepResult completed() = 0;
  /// `max_distance_mm`: as in TouchRound.
  void startRound(calibration::TargetPlan plan, double max_distance_mm) {
    round_.emplace(std::move(plan), context_.arm, max_distance_mm, context_.announcements);
  }

  std::optional<TouchRound> round_;
};

}  // namespace app
