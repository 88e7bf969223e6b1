// Where the eyes are: the distance between the pupils and that of the eyes from the virtual screen. One thread.

#include <cmath>

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"

namespace app {
namespace {

class EyesStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    const calibration::Rig rig = rigSoFar(context_.plan.record.rig, context_.outcome);
    pupils_ = NumberDial(std::round(glm::length(rig.right_eye.mm - rig.left_eye.mm)), 50.0, 76.0, 1.0);
    distance_ = NumberDial(5.0 * std::round(glm::length(rig.cyclopeanEye().mm) / 5.0), 250.0, 900.0, 5.0);
    has_pupils_ = false;
  }

  StepResult update(const StylusSample&, Press press, double) override {
    if (!has_pupils_) {
      if (pupils_.update(press)) {
        context_.outcome.ipd_mm = pupils_.value();
        has_pupils_ = true;
      }
      return {};
    }
    if (!distance_.update(press)) return {};
    context_.outcome.eye_distance_mm = distance_.value();
    // Measured again after the crosses: they are looked at again.
    return context_.outcome.arm ? StepResult::goTo(StepName::eye_check) : StepResult::next();
  }

  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    if (!has_pupils_) {
      view.title = "How far apart are the pupils?";
      view.sentence = "Of the surgeon: ruler at the brow, eyes looking into the distance.";
      pupils_.show(view, "mm");
      return;
    }
    view.title = "How far is the eye from the screen?";
    view.sentence =
        context_.plan.record.rig.mirror
            ? "With a tape, head in the rest: from the eye to the mirror, and on from the mirror to the screen."
            : "With a tape, head in the rest: from the eye straight to the screen.";
    distance_.show(view, "mm");
  }

 private:
  NumberDial pupils_{63.0, 50.0, 76.0, 1.0}, distance_{450.0, 250.0, 900.0, 5.0};
  bool has_pupils_ = false;
};

}  // namespace

std::unique_ptr<WizardStep> eyesStep(WizardContext& context) { return std::make_unique<EyesStep>(context); }

}  // namespace app
