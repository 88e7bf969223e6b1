#include "app/calibrate/wizard_outcome.h"

#include "app/calibrate/calibrated_rig.h"
#include "app/calibrate/steps/eyes_step.h"

namespace app {

calibration::RigRecord recordOf(const WizardPlan& plan, const WizardOutcome& outcome) {
  calibration::RigRecord record = plan.record;
  if (outcome.end != WizardOutcome::End::accepted) return record;
  record.rig = rigSoFar(plan.record.rig, outcome);
  record.hash.clear();

  if (outcome.arm) {
    record.rig.device = plan.device;
    record.rig.X_WD = outcome.arm->X_WD;
    record.rig.arm = outcome.arm->correction;
  }
  if (const auto& fit = outcome.fit)
    putFit(record, outcome.touches, *fit, outcome.duration_s);
  else if (const auto& rezero = outcome.rezero)
    putRezero(record, outcome.zeroing, *rezero, outcome.duration_s);
  if (outcome.errors && outcome.judgement) putProof(record, outcome.proof_residuals, outcome.proof_kind);
  if (outcome.rest) record.rest = outcome.rest;
  return record;
}

}  // namespace app
