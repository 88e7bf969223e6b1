// Touches that the calibration has not seen, held in new ways: after a full one 16 of them, at the start of a session
// 4. They are judged; at a session what is not good is brought up to date, once, and checked again. One thread.
#pragma once

#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {

class ProofStep final : public WizardStep {
 public:
  /// `method`: verify8 or check4.
  ProofStep(WizardBook& book, const char* method) : book_(book), method_(method) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  void lost() override { round_->lost(); }
  void show(WizardView& view) const override;

 private:
  bool isCheck() const;

  WizardBook& book_;
  std::string method_;
  std::optional<TouchRound> round_;
};

}  // namespace app
