// Four crosses in stereo, before and behind the screen's plane: where they seem to be tells whether pupils and distance
// were measured well. Eyes are never solved from them: so few alignments leave 20 mm open. One thread.
// Source: reference/calibration 2.2.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {

class EyeCheckStep final : public WizardStep {
 public:
  explicit EyeCheckStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  void lost() override { round_->lost(); }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  std::optional<TouchRound> round_;
  std::optional<ChoiceMenu> doubt_;
  std::string finding_;
};

/// Where they are, and how the stylus is held there.
calibration::TargetPlan eyeCheckPlan();

}  // namespace app
