#include "app/calibrate/wizard_outcome.h"

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
  if (const auto& fit = outcome.fit) {
    record.procedure =
        calibration::RigProcedure{outcome.touches.method, fit->model,           fit->used,
                                  fit->outliers,          fit->tilt_spread_deg, outcome.duration_s,
                                  fit->fre_rms_mm,        fit->cv_rms_mm,       outcome.touches.precision};
    record.residuals = fit->residuals;
    record.sigma = fit->sigma;
  } else if (const auto& rezero = outcome.rezero) {
    // Tilts and cross-validation are still those of the calibration that was brought up to date.
    calibration::RigProcedure procedure = record.procedure.value_or(calibration::RigProcedure{});
    procedure.method = outcome.zeroing.method;
    procedure.used = static_cast<int>(outcome.zeroing.touches.size()) - rezero->outliers;
    procedure.outliers = rezero->outliers;
    procedure.duration_s = outcome.duration_s;
    procedure.fre_rms_mm = rezero->after_rms_mm;
    record.procedure = procedure;
    record.residuals = rezero->residuals;
  }
  if (outcome.errors && outcome.judgement)
    record.proof = calibration::RigProof{*outcome.errors, outcome.proof_kind, outcome.judgement->verdict, {}};
  if (const auto& rest = outcome.rest)
    record.rest = calibration::HandRest{rest->rotation, rest->translation_mm, rest->fre_rms_mm, rest->worst_mm};
  return record;
}

}  // namespace app
