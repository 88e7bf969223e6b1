// How large the screen's pixels are: a bar of 100 mm across and one upright, measured with a ruler. One thread.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {

class LengthStep final : public WizardStep {
 public:
  explicit LengthStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  NumberDial dial_{100.0, 70.0, 130.0, 0.5};
  std::optional<double> across_mm_;
};

}  // namespace app
