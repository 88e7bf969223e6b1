// Five touches bring a calibration up to date after homing or a push. One thread.

#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {
namespace {

constexpr double kFarBase_mm = 25.0;  // a base that was pushed
constexpr double kMostLeft_mm = 2.0;  // after it: beyond, a touch was of another pit, or the arm is another

class RezeroStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    const calibration::TargetPlan plan = *calibration::targetPlan("rezero5", context_.plan.jig);
    context_.outcome.zeroing = emptySet(context_, plan);
    round_.emplace(plan, context_.arm, kFarBase_mm, context_.announcements);
  }

  StepResult update(const StylusSample& sample, Press press, double pressed_s) override {
    if (round_->update(sample, press, pressed_s) == TouchRound::TouchEvent::left) return StepResult::declined();
    if (!round_->isComplete()) return {};
    context_.outcome.zeroing.touches = round_->touches();
    context_.outcome.duration_s = round_->duration_s();

    try {
      const calibration::Rezero rezero = calibration::rezeroed(context_.arm, context_.outcome.zeroing);
      if (rezero.after_rms_mm > kMostLeft_mm) {
        context_.announcements.refuse("The touches do not fit together (" + mmText(rezero.after_rms_mm) +
                                      "): touch the pits in the order they glow.");
        begin();
        return {};
      }
      context_.outcome.rezero = rezero;
      context_.outcome.arm = rezero.arm;
      context_.arm = rezero.arm;
      context_.announcements.praise("Up to date: the base had moved by " + mmText(rezero.moved_mm) + ".",
                                    WizardSound::next);
      return StepResult::goTo(StepName::check);
    } catch (const calibration::CalibrationError& error) {
      context_.announcements.refuse(error.what());
      begin();
      return {};
    }
  }

  void lost() override { round_->lost(); }
  void show(WizardView& view) const override {
    view.title = "Bring it up to date";
    view.sentence = "Tip into the glowing pit, held as the cue shows.";
    round_->show(view);
  }

 private:
  std::optional<TouchRound> round_;
};

}  // namespace

std::unique_ptr<WizardStep> rezeroStep(WizardContext& context) { return std::make_unique<RezeroStep>(context); }

}  // namespace app
