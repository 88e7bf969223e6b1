// Five touches bring a calibration up to date after homing or a push. One thread.
#pragma once

#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {

class RezeroStep final : public WizardStep {
 public:
  explicit RezeroStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  void lost() override { round_->lost(); }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  std::optional<TouchRound> round_;
};

}  // namespace app
