// The end: one sentence, the numbers on a second page, and whether it is taken. What is red can not be. One thread.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {

class SignOffStep final : public WizardStep {
 public:
  explicit SignOffStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  enum class Choice { take, numbers, repeat, leave };
  calibration::Verdict verdict() const;
  std::string sentence() const;
  std::vector<ShownNumber> numbers() const;

  WizardBook& book_;
  std::vector<Choice> choices_;
  ChoiceMenu menu_{{}};
  bool second_page_ = false;
};

}  // namespace app
