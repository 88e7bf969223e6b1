// The device finds its zero in its inkwell, and gets time to settle. One thread.
#pragma once

#include "app/calibrate/steps/step.h"

namespace app {

class HomeStep final : public WizardStep {
 public:
  explicit HomeStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  void lost() override { begin(); }
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  enum class Phase { to_inkwell, settling, take_out } phase_ = Phase::to_inkwell;
  double since_s_ = 0.0, settled_s_ = 0.0;
  bool seen_ = false;
};

}  // namespace app
