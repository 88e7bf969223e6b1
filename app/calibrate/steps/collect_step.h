// The touches of the calibration, judged while they come in: after eight, each is compared with where the others
// foretell it. At the end the worst can be made again; one stylus direction for all is not let through. One thread.
#pragma once

#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {

class CollectStep final : public WizardStep {
 public:
  explicit CollectStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  void lost() override { round_->lost(); }
  void show(WizardView& view) const override;

 private:
  void judgeSoFar();
  void askAtTheEnd();
  StepAnswer answered(std::size_t choice);
  calibration::TouchSet touches() const;

  WizardBook& book_;
  std::optional<TouchRound> round_;
  std::optional<ChoiceMenu> end_;
  std::optional<std::size_t> worst_;
  double worst_mm_ = 0.0;
  bool little_tilt_ = false;
  int held_one_way_ = 0;  ///< times
};

/// A touch set of the plan's device, ready for its touches.
calibration::TouchSet emptySet(const WizardBook& book, const calibration::TargetPlan& plan);

}  // namespace app
