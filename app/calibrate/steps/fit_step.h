// The arm is worked out from its touches; what makes the result less than it seems is said. One thread; feel() takes up
// to a second once.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {

class FitStep final : public WizardStep {
 public:
  explicit FitStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  void work();
  void refuse(std::string why);

  WizardBook& book_;
  std::optional<double> since_s_;
  bool worked_ = false, failed_ = false;
  std::string why_;
  ChoiceMenu menu_{{}};
};

}  // namespace app
