// Where the hand rest stands: three touches of its marks make its pose, three more prove it. One thread.
#pragma once

#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {

class RestStep final : public WizardStep {
 public:
  explicit RestStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  void lost() override { round_->lost(); }
  void show(WizardView& view) const override;

 private:
  std::vector<calibration::MarkTouch> touched() const;
  void beginProof();

  WizardBook& book_;
  std::optional<TouchRound> round_;
  std::vector<calibration::MarkTouch> made_of_;  ///< empty: they are being touched
};

}  // namespace app
