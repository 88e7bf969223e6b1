// Whether the picture reaches the eye the right way round: a drawn F must read right. One thread.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {

class FlipStep final : public WizardStep {
 public:
  explicit FlipStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  ChoiceMenu menu_{{}};
  bool which_ = false;  ///< it does not read right: asked how
};

}  // namespace app
