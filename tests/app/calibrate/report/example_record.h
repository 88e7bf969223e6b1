// A calibration of a synthetic workstation by jig, proved by held-out touches, and two months of checks: what a report
// is made of.
#pragma once

#include <random>

#include "calibration/fit/arm_fit.h"
#include "calibration/record/drift_history.h"
#include "calibration/record/rig_record.h"
#include "calibration/record/utc.h"
#include "calibration/synthetic/synthetic_rig.h"

namespace app {

inline calibration::RigRecord exampleRecord() {
  using namespace calibration;
  std::mt19937 rng(7);
  const SyntheticRig rig = syntheticRig(Scenario::d, 7);
  TouchSet touches = simulatedTouches(rig, *targetPlan("jig27"), rng);
  touches.touches[12].target_W.mm += glm::dvec3(9.0, -6.0, 10.0);  // a wrong pit
  const ArmFit fit = fitArm(touches);

  RigRecord record;
  record.rig = rig.nominal;
  record.rig.X_WD = fit.arm.X_WD;
  record.rig.arm = fit.arm.correction;
  record.rig.device = RigDevice{"omni", "60623200012", "right", "burr-3mm-07"};
  record.provenance = {"rig-02", "2026-11-21T08:20:00Z", "0.1.0", "4.6.0", "tech-07", "half_silvered", 2.0, ""};
  record.procedure = RigProcedure{"jig27", fit.model,      fit.used,      fit.outliers,     fit.tilt_spread_deg,
                                  171.0,   fit.fre_rms_mm, fit.cv_rms_mm, touches.precision};
  record.residuals = fit.residuals;
  RigVerification verification;
  verification.residuals = residualsOf(fit.arm, heldOutTouches(rig, 16, {65.0, 45.0, 32.0}, rng));
  verification.errors = targetErrors(verification.residuals);
  verification.verdict = assess(verification.errors, VerificationKind::full).verdict;
  verification.checked_utc = "2026-11-21T08:24:00Z";
  record.verification = verification;
  return record;
}

/// A calibration, daily checks about 0.3 mm, a base that slips upwards on the last days, re-zeros at times.
inline std::vector<calibration::DriftEntry> exampleHistory() {
  using namespace calibration;
  std::mt19937 rng(5);
  std::normal_distribution<double> noise(0.0, 0.05);
  std::vector<DriftEntry> history;
  for (int day = 0; day < 45; ++day) {
    DriftEntry entry{utcOf(1795249200 + 86400LL * day), DriftKind::check, 4, 0.3 + noise(rng), {}};
    entry.bias_mm = {{noise(rng), noise(rng), noise(rng)}};
    if (day == 10) entry.kind = DriftKind::calibration;
    if (day % 9 == 5) entry.kind = DriftKind::rezero;
    if (day > 40) entry.bias_mm.xyz.y += 0.12 * (day - 40), entry.rms_mm += 0.09 * (day - 40);
    history.push_back(entry);
  }
  return history;
}

}  // namespace app
