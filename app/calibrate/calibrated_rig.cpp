#include "app/calibrate/calibrated_rig.h"

#include <cmath>

#include "app/text/version.h"
#include "calibration/arm/phantom_models.h"
#include "calibration/checked_yaml.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/rig_store.h"
#include "calibration/record/utc.h"

namespace app {

using namespace calibration;

namespace {

/// An error that tips left out cannot show: of the lens, common to all. From simulated rigs: cross-validated 0.1 mm,
/// true error 0.25 mm.
constexpr double kHidden_mm = 0.2;

}  // namespace

RigRecord baseRig(const std::string& named) {
  const auto default_rig = defaultRig(named);
  if (!default_rig) return readRigRecord(named);
  RigRecord record;
  record.rig = *default_rig;
  return record;
}

MeasuredArm armOf(const RigRecord& record, const TouchSet& touches, const std::string& named) {
  const PhantomModel* const model = findPhantomModel(touches.device_model);
  if (model == nullptr)
    throw CalibrationError("observations: device '" + touches.device_model + "' is not known, give one of " +
                           phantomModelKeys());
  if (record.rig.device) {
    const std::string why = mismatchWith(record, touches.device_model, touches.serial, touches.mount);
    if (!why.empty()) throw CalibrationError("rig file " + named + ": " + why);
  }
  return {model->geometry, record.rig.arm.value_or(ArmCorrection{}), record.rig.X_WD};
}

void stamp(RigRecord& record, const RigRecord& base, const MeasurementInfo& info) {
  const std::string now = nowUtc();
  record.provenance.rig_id = info.rig_id;
  record.provenance.created_utc = now;
  record.provenance.program = programVersion();
  record.provenance.opencv = openCvVersion();
  record.provenance.operator_code = info.operator_code;
  record.provenance.parent = base.hash;
  if (!info.patient_position.empty()) record.patient_position = info.patient_position;
  record.hash.clear();
  if (record.verification && record.verification->checked_utc.empty()) record.verification->checked_utc = now;
}

void putFit(RigRecord& record, const TouchSet& touches, const ArmFit& fit, double duration_s) {
  record.rig.arm = fit.arm.correction;
  record.rig.X_WD = fit.arm.X_WD;
  record.residuals = fit.residuals;
  record.sigma = fit.sigma;
  record.procedure = RigProcedure{touches.method, fit.model,      fit.used,      fit.outliers,     fit.tilt_spread_deg,
                                  duration_s,     fit.fre_rms_mm, fit.cv_rms_mm, touches.precision};
  record.verification.reset();
}

void putRezero(RigRecord& record, const TouchSet& touches, const Rezero& rezero, double duration_s) {
  record.rig.arm = rezero.arm.correction;
  record.rig.X_WD = rezero.arm.X_WD;
  record.residuals = rezero.residuals;
  RigProcedure procedure = record.procedure.value_or(RigProcedure{});
  procedure.method = touches.method;
  procedure.used = static_cast<int>(touches.touches.size()) - rezero.outliers;
  procedure.outliers = rezero.outliers;
  procedure.duration_s = duration_s;
  procedure.fre_rms_mm = rezero.after_rms_mm;
  record.procedure = procedure;
  record.verification.reset();
}

void putPivot(RigRecord& record, const MeasuredArm& arm, const Pivot& pivot, const std::string& name) {
  record.rig.arm = arm.correction;
  record.rig.arm->tip_H_mm = pivot.tip_H_mm;
  if (record.rig.device && !name.empty()) record.rig.device->stylus_tip = name;
  record.verification.reset();
}

void putWebcamFit(RigRecord& record, const WebcamFit& fit) {
  record.rig.arm = fit.arm.correction;
  record.rig.X_WD = fit.arm.X_WD;
  record.residuals = fit.residuals;
  record.sigma = fit.sigma;
  record.procedure = RigProcedure{"webcam" + std::to_string(fit.X_WC.size()),
                                  fit.model,
                                  fit.used,
                                  fit.outliers,
                                  fit.tilt_spread_deg,
                                  0.0,
                                  fit.fre_rms_mm,
                                  fit.cv_rms_mm,
                                  {}};

  // The cross-validated error and the hidden one, distributed as the fitted residuals.
  std::vector<Residual> left_out = fit.residuals;
  const double fitted_mm = targetErrors(left_out).rms_mm;
  for (Residual& one : left_out)
    one.error_mm.xyz *= fitted_mm > 0.0 ? std::hypot(fit.cv_rms_mm, kHidden_mm) / fitted_mm : 1.0;
  putVerification(record, left_out, VerificationKind::full);
}

void putVerification(RigRecord& record, const std::vector<Residual>& held_out, VerificationKind kind) {
  RigVerification verification;
  verification.errors = targetErrors(held_out);
  verification.kind = kind;
  verification.verdict = assess(verification.errors, kind).verdict;
  verification.worst = worstErrorSentence(held_out, {});
  verification.residuals = held_out;
  record.verification = verification;
}

VerificationKind verificationKindOf(const std::string& method) {
  return method.starts_with("visual") ? VerificationKind::by_eyes : VerificationKind::full;
}

}  // namespace app
