#include "app/calibrate/calibrated_rig.h"

#include <ctime>

#include "calibration/checked_yaml.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

using namespace calibration;

/// A new file that comes of `base`.
RigRecord successor(const RigRecord& base, const Measuring& measuring) {
  RigRecord record = base;
  record.provenance.rig_id = measuring.rig_id;
  record.provenance.created_utc = utcNow();
  record.provenance.program = MOLAR_VERSION;
  record.provenance.opencv = openCvVersion();
  record.provenance.operator_code = measuring.operator_code;
  record.provenance.parent = base.hash;
  record.hash.clear();
  record.proof.reset();
  return record;
}

}  // namespace

std::string utcNow() { return utcOf(std::time(nullptr)); }

ProofKind proofKindOf(const std::string& method) {
  return method.starts_with("visual") ? ProofKind::by_eyes : ProofKind::full;
}

RigRecord fittedRig(const RigRecord& base, const TouchSet& touches, const ArmFit& fit, const Measuring& measuring) {
  RigRecord record = successor(base, measuring);
  record.rig.device = RigDevice{touches.device_model, measuring.serial, measuring.mount, measuring.stylus_tip};
  record.rig.arm = fit.arm.correction;
  record.rig.X_WD = fit.arm.X_WD;
  record.residuals = fit.residuals;
  record.sigma = fit.sigma;
  record.procedure = RigProcedure{measuring.method.empty() ? touches.method : measuring.method,
                                  fit.model,
                                  fit.used,
                                  fit.outliers,
                                  fit.tilt_spread_deg,
                                  measuring.duration_s,
                                  fit.fre_rms_mm,
                                  fit.cv_rms_mm,
                                  touches.precision};
  return record;
}

RigRecord rezeroedRig(const RigRecord& base, const Rezero& rezero, const Measuring& measuring) {
  RigRecord record = successor(base, measuring);
  record.rig.arm = rezero.arm.correction;
  record.rig.X_WD = rezero.arm.X_WD;
  record.residuals = rezero.residuals;
  return record;
}

void prove(RigRecord& record, const std::vector<Residual>& held_out, ProofKind kind) {
  RigProof proof;
  proof.errors = targetErrors(held_out);
  proof.kind = kind;
  proof.verdict = judge(proof.errors, kind).verdict;
  proof.checked_utc = utcNow();
  record.proof = proof;
}

}  // namespace app
