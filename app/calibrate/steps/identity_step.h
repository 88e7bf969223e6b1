// Which rig, device, side and stylus tip: shown, and confirmed by who holds it. One thread.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {

class IdentityStep final : public WizardStep {
 public:
  explicit IdentityStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  ChoiceMenu menu_{{}};
};

}  // namespace app
