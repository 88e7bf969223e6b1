// Where the eyes are: the distance between the pupils and that of the eyes from the virtual screen. One thread.
#pragma once

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {

class EyesStep final : public WizardStep {
 public:
  explicit EyesStep(WizardBook& book) : book_(book) {}
  void begin() override;
  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override;
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override;

 private:
  WizardBook& book_;
  NumberDial pupils_{63.0, 50.0, 76.0, 1.0}, distance_{450.0, 250.0, 900.0, 5.0};
  bool has_pupils_ = false;
};

/// The rig with what is known by now of screen and eyes.
calibration::Rig rigSoFar(const calibration::Rig& rig, const WizardOutcome& outcome);

}  // namespace app
