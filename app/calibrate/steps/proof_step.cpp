#include "app/calibrate/steps/proof_step.h"

#include "app/calibrate/number_words.h"
#include "app/calibrate/steps/collect_step.h"

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

}  // namespace

bool ProofStep::isCheck() const { return method_ == "check4"; }

void ProofStep::begin() {
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

StepAnswer ProofStep::feel(const StylusSample& sample, Press press, double pressed_s) {
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

void ProofStep::show(WizardView& view) const {
  view.title = isCheck() ? "Check" : "Prove it";
  const std::string noun = !isCheck() && book_.byEyes() ? "cross" : "pit";
  view.sentence = "Tip to the glowing " + noun + ", held as the cue shows: touches that nothing was fitted to.";
  round_->show(view);
}

}  // namespace app
