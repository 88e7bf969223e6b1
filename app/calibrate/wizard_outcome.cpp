#include "app/calibrate/wizard_outcome.h"

#include "app/calibrate/calibrated_rig.h"

namespace app {

calibration::Rig rigSoFar(const calibration::Rig& rig, const WizardOutcome& outcome) {
  calibration::Rig known = rig;
  if (outcome.screen) known.screen = *outcome.screen;
  if (!outcome.ipd_mm && !outcome.eye_distance_mm) return known;

  // The head looks as before, from further or nearer, its pupils further or less apart.
  const glm::dvec3 between_mm = rig.right_eye.mm - rig.left_eye.mm;
  const glm::dvec3 middle_mm = rig.cyclopeanEye().mm;
  if (glm::length(between_mm) == 0.0 || glm::length(middle_mm) == 0.0) return known;
  const double ipd_mm = outcome.ipd_mm.value_or(glm::length(between_mm));
  const double distance_mm = outcome.eye_distance_mm.value_or(glm::length(middle_mm));
  const glm::dvec3 head_mm = distance_mm * glm::normalize(middle_mm);
  known.left_eye.mm = head_mm - 0.5 * ipd_mm * glm::normalize(between_mm);
  known.right_eye.mm = head_mm + 0.5 * ipd_mm * glm::normalize(between_mm);
  return known;
}

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
  if (outcome.errors && outcome.assessment)
    putVerification(record, outcome.verification_residuals, outcome.verification_kind);
  if (outcome.rest) record.rest = outcome.rest;
  return record;
}

}  // namespace app
