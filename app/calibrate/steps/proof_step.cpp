// Touches that the calibration has not seen, held in new ways: after a full one 16 of them, at the start of a session
// 4. They are judged; at a session what is not good is brought up to date, once, and checked again. One thread.

#include "app/calibrate/number_words.h"
#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {
namespace {

/// Proof by eyes: the same directions, at places of the screen's plane halfway between the crosses of the fit.
void ontoTheScreen(calibration::TargetPlan& plan) {
  constexpr double kOuter = 1.27, kInner = 0.42;
  plan.kind = calibration::TargetKind::cross;
  plan.precision = calibration::kCrossPrecision;
  for (calibration::Target& target : plan.targets) {
    const double scale = target.place_W.mm.z < 0.0 ? kOuter : kInner;
    target.place_W.mm = {scale * target.place_W.mm.x, scale * target.place_W.mm.y, 0.0};
  }
}

class ProofStep final : public WizardStep {
 public:
  /// `method`: verify8 or check4.
  ProofStep(WizardBook& book, const char* method) : WizardStep(book), method_(method) {}
  void begin() override {
    const bool by_eyes = !isCheck() && book_.byEyes();
    calibration::TargetPlan plan = *calibration::targetPlan(method_, by_eyes ? calibration::JigPose{} : book_.plan.jig);
    if (by_eyes) ontoTheScreen(plan);
    book_.outcome.proof = emptySet(book_, plan);
    book_.outcome.proof_kind = isCheck() ? calibration::ProofKind::session_check
                               : by_eyes ? calibration::ProofKind::by_eyes
                                         : calibration::ProofKind::full;
    // After a night the base may stand elsewhere by some millimetres.
    round_.emplace(std::move(plan), book_.arm, isCheck() ? 12.0 : book_.far_mm(), book_.voice);
  }

  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override {
    if (round_->feel(sample, press, pressed_s) == TouchRound::Happened::left) return StepAnswer::declined();
    if (!round_->isComplete()) return {};

    WizardOutcome& outcome = book_.outcome;
    outcome.proof.touches = round_->touches();
    outcome.proof_residuals = calibration::residualsOf(book_.arm, outcome.proof.touches);
    outcome.errors = calibration::targetErrors(outcome.proof_residuals);
    outcome.judgement = calibration::judge(*outcome.errors, outcome.proof_kind);
    const bool good = outcome.judgement->verdict == calibration::Verdict::green;
    if (isCheck() && !good && !outcome.rezero) {
      book_.voice.refuse("The arm is " + inMm(outcome.errors->rms_mm) + " off: five touches bring it up to date.");
      return StepAnswer::goTo(StepName::rezero);
    }
    return StepAnswer::goTo(StepName::sign_off);
  }

  void lost() override { round_->lost(); }
  void show(WizardView& view) const override {
    view.title = isCheck() ? "Check" : "Prove it";
    const std::string noun = !isCheck() && book_.byEyes() ? "cross" : "pit";
    view.sentence = "Tip to the glowing " + noun + ", held as the cue shows: touches that nothing was fitted to.";
    round_->show(view);
  }

 private:
  bool isCheck() const { return method_ == "check4"; }

  std::string method_;
  std::optional<TouchRound> round_;
};

}  // namespace

std::unique_ptr<WizardStep> verifyStep(WizardBook& book) { return std::make_unique<ProofStep>(book, "verify8"); }
std::unique_ptr<WizardStep> checkStep(WizardBook& book) { return std::make_unique<ProofStep>(book, "check4"); }

}  // namespace app
