// Touches that the calibration has not seen, held in new ways: after a full one 16 of them, at the start of a session
// 4. They are assessed; a session check that is not green is followed by one re-zero and checked again. One thread.

#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/touch_step.h"

namespace app {
namespace {

/// Verification by eye: the same directions, at positions of the screen plane halfway between the crosses of the fit.
void ontoTheScreen(calibration::TargetPlan& plan) {
  constexpr double kOuter = 1.27, kInner = 0.42;
  plan.kind = calibration::TargetKind::cross;
  plan.precision = calibration::kCrossPrecision;
  for (calibration::Target& target : plan.targets) {
    const double scale = target.position_W.mm.z < 0.0 ? kOuter : kInner;
    target.position_W.mm = {scale * target.position_W.mm.x, scale * target.position_W.mm.y, 0.0};
  }
}

class VerificationStep final : public TouchStep {
 public:
  /// `method`: verify8 or check4.
  VerificationStep(WizardContext& context, const char* method) : TouchStep(context), method_(method) {}
  void begin() override {
    const bool by_eyes = !isCheck() && context_.byEyes();
    calibration::TargetPlan plan =
        *calibration::targetPlan(method_, by_eyes ? calibration::JigPose{} : context_.plan.jig);
    if (by_eyes) ontoTheScreen(plan);
    context_.outcome.verification = emptySet(context_, plan);
    context_.outcome.verification_kind = isCheck() ? calibration::VerificationKind::session_check
                                         : by_eyes ? calibration::VerificationKind::by_eyes
                                                   : calibration::VerificationKind::full;
    // After a night the base may stand elsewhere by some millimetres.
    round_.emplace(std::move(plan), context_.arm, isCheck() ? 12.0 : context_.max_distance_mm(),
                   context_.announcements);
  }

  void show(WizardView& view) const override {
    view.title = isCheck() ? "Check" : "Verify";
    const std::string noun = !isCheck() && context_.byEyes() ? "cross" : "pit";
    view.sentence = "Put the tip to the glowing " + noun + ", tilted as shown. These touches are not fitted.";
    round_->show(view);
  }

 private:
  StepResult completed() override {
    WizardOutcome& outcome = context_.outcome;
    outcome.verification.touches = round_->touches();
    outcome.verification_residuals = calibration::residualsOf(context_.arm, outcome.verification.touches);
    outcome.errors = calibration::targetErrors(outcome.verification_residuals);
    outcome.assessment = calibration::assess(*outcome.errors, outcome.verification_kind);
    const bool good = outcome.assessment->verdict == calibration::Verdict::green;
    if (isCheck() && !good && !outcome.rezero) {
      context_.announcements.refuse("The arm is " + mmText(outcome.errors->rms_mm) +
                                    " off: five touches will update it.");
      return StepResult::goTo(StepName::rezero);
    }
    return StepResult::goTo(StepName::sign_off);
  }

  bool isCheck() const { return method_ == "check4"; }

  std::string method_;
};

}  // namespace

std::unique_ptr<WizardStep> verifyStep(WizardContext& context) {
  return std::make_unique<VerificationStep>(context, "verify8");
}
std::unique_ptr<WizardStep> checkStep(WizardContext& context) {
  return std::make_unique<VerificationStep>(context, "check4");
}

}  // namespace app
