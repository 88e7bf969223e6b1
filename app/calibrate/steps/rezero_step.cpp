// Five touches bring a calibration up to date after homing or a push. One thread.

#include "app/calibrate/number_words.h"
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
    const calibration::TargetPlan plan = *calibration::targetPlan("rezero5", book_.plan.jig);
    book_.outcome.zeroing = emptySet(book_, plan);
    round_.emplace(plan, book_.arm, kFarBase_mm, book_.voice);
  }

  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override {
    if (round_->feel(sample, press, pressed_s) == TouchRound::Happened::left) return StepAnswer::declined();
    if (!round_->isComplete()) return {};
    book_.outcome.zeroing.touches = round_->touches();
    book_.outcome.duration_s = round_->duration_s();

    try {
      const calibration::Rezero rezero = calibration::rezeroed(book_.arm, book_.outcome.zeroing);
      if (rezero.after_rms_mm > kMostLeft_mm) {
        book_.voice.refuse("The touches do not fit together (" + inMm(rezero.after_rms_mm) +
                           "): touch the pits in the order they glow.");
        begin();
        return {};
      }
      book_.outcome.rezero = rezero;
      book_.outcome.arm = rezero.arm;
      book_.arm = rezero.arm;
      book_.voice.praise("Up to date: the base had moved by " + inMm(rezero.moved_mm) + ".", WizardSound::next);
      return StepAnswer::goTo(StepName::check);
    } catch (const calibration::CalibrationError& error) {
      book_.voice.refuse(error.what());
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

std::unique_ptr<WizardStep> rezeroStep(WizardBook& book) { return std::make_unique<RezeroStep>(book); }

}  // namespace app
