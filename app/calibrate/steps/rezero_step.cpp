// Five touches update a calibration after homing or after the base was moved. One thread.

#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/touch_step.h"

namespace app {
namespace {

constexpr double kMaxBaseShift_mm = 25.0;
constexpr double kMaxRms_mm = 2.0;  // above it a wrong pit was touched, or the arm is another

class RezeroStep final : public TouchStep {
 public:
  using TouchStep::TouchStep;
  void begin() override {
    const calibration::TargetPlan plan = *calibration::targetPlan("rezero5", context_.plan.jig);
    context_.outcome.zeroing = emptySet(context_, plan);
    startRound(plan, kMaxBaseShift_mm);
  }

  void show(WizardView& view) const override {
    view.title = "Update the calibration";
    view.sentence = "Put the tip into the glowing pit, tilted as shown.";
    round_->show(view);
  }

 private:
  StepResult completed() override {
    context_.outcome.zeroing.touches = round_->touches();
    context_.outcome.duration_s = round_->duration_s();
    const calibration::Rezero rezero = calibration::rezeroed(context_.arm, context_.outcome.zeroing);
    if (rezero.after_rms_mm > kMaxRms_mm)
      throw calibration::CalibrationError("The touches do not fit together (" + mmText(rezero.after_rms_mm) +
                                          "): touch the pits in the order in which they glow.");
    context_.outcome.rezero = rezero;
    context_.outcome.arm = rezero.arm;
    context_.arm = rezero.arm;
    context_.announcements.praise("Updated: the base had moved by " + mmText(rezero.moved_mm) + ".", WizardSound::next);
    return StepResult::goTo(StepName::check);
  }
};

}  // namespace

std::unique_ptr<WizardStep> rezeroStep(WizardContext& context) { return std::make_unique<RezeroStep>(context); }

}  // namespace app
