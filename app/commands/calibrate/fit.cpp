// `molar calibrate fit`: from touches to a rig file.

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/fit/touch_checks.h"
#include "calibration/fit/touches_file.h"
#include "calibration/webcam/webcam_file.h"

namespace app {
namespace {

using namespace calibration;

struct CalibrateFitOptions {
  std::string observations, model = "auto", rig = "mirrored", held_out;
  double region_mm3 = 0.0;
  MeasurementInfo info;
  KeepOption keep;
  bool json = false;
};

FitOptions fitOptions(const CalibrateFitOptions& options) {
  FitOptions fit;
  fit.region_mm3 = options.region_mm3;
  if (options.model != "auto") fit.model = armModelNamed(options.model == "harders" ? "joints" : options.model);
  return fit;
}

/// The verdict until it is verified: from the cross-validation error, as if all touches were held out.
Verdict predictedVerdict(const ArmFit& fit, VerificationKind kind) {
  TargetErrors errors;
  errors.n = fit.used;
  errors.mean_mm = errors.rms_mm = fit.cv_rms_mm;
  errors.bias_mm = fit.bias_mm;
  return assess(errors, kind).verdict;
}

/// Warnings of a fit that may hold only near the measured poses, which no residual shows.
bool isDoubtful(const ArmFit& fit) {
  using Kind = FitWarning::Kind;
  return std::ranges::any_of(fit.warnings, [](const FitWarning& warning) {
    return warning.kind == Kind::mirrored || warning.kind == Kind::little_tilt || warning.kind == Kind::many_outliers;
  });
}

/// A given serial must match the measured unit.
std::string serialOf(const std::string& given, const std::string& measured) {
  if (!given.empty() && !measured.empty() && given != measured)
    throw UsageError("--serial " + given + ": the observations were made with '" + measured + "', leave it out");
  return given.empty() ? measured : given;
}

/// Residuals of touches of the same device outside the fit.
std::vector<Residual> heldOut(const std::string& path, const MeasuredArm& arm, const TouchSet& fitted) {
  const TouchSet verification = readTouches(path);
  checkUnseen(fitted, verification);
  return residualsOf(arm, verification.touches);
}

/// Fits the observations of a webcam.
int fitWebcamFile(const CalibrateFitOptions& options) {
  const WebcamObservations observations = readWebcamFile(options.observations);
  const RigRecord base = baseRig(options.rig);
  MeasurementInfo info = options.info;
  info.serial = serialOf(info.serial, observations.serial);
  if (!observations.mount.empty()) info.mount = observations.mount;
  const WebcamFit fitted = fitWebcam(observations, fitOptions(options).model.value_or(ArmModel::full));
  std::vector<Residual> verification;
  if (!options.held_out.empty()) {
    TouchSet device;
    device.device_model = observations.device_model;
    device.serial = info.serial;
    device.mount = info.mount;
    verification = heldOut(options.held_out, fitted.arm, device);
  }
  const int status = conclude(observations, fitted, base, info, options.keep, verification);
  if (options.json) std::fputs(webcamFitJson(fitted).c_str(), stdout);
  return status;
}

int fit(const CalibrateFitOptions& options) {
  options.keep.refuseUnlessWritable();
  if (isWebcamFile(options.observations)) return fitWebcamFile(options);
  const TouchSet touches = readTouches(options.observations);
  const RigRecord base = baseRig(options.rig);
  MeasurementInfo info = options.info;
  info.serial = serialOf(info.serial, touches.serial);
  if (!touches.mount.empty()) info.mount = touches.mount;

  const ArmFit fitted = fitArm(touches, fitOptions(options));
  RigRecord record = base;
  record.rig.device = RigDevice{touches.device_model, info.serial, info.mount, info.stylus_tip};
  putFit(record, touches, fitted, 0.0);
  const VerificationKind kind = verificationKindOf(touches.method);
  std::string verification_text;
  if (!options.held_out.empty()) {
    putVerification(record, heldOut(options.held_out, fitted.arm, touches), kind);
    verification_text = verificationText(record.verification->errors, assess(record.verification->errors, kind));
  }
  stamp(record, base, info);
  std::fputs(fitText(fitted).c_str(), stderr);
  std::fputs(verification_text.c_str(), stderr);
  options.keep.keep(record, touchesText(touches));
  if (record.verification) options.keep.note(record, DriftKind::calibration, record.verification->errors);
  if (options.json) std::fputs(fitJson(fitted).c_str(), stdout);
  if (isDoubtful(fitted)) return 1;
  return statusOf(record.verification ? record.verification->verdict : predictedVerdict(fitted, kind));
}

}  // namespace

void addCalibrateFit(CommandLine& calibrate) {
  auto o = std::make_shared<CalibrateFitOptions>();
  CommandLine& command = calibrate.command("fit", "From touches to a rig file; exit 0 green, 1 amber or red");
  command.option("OBSERVATIONS", o->observations, "Touches, or what a webcam saw; YAML").required();
  command
      .option("--model", o->model,
              "rigid, joints (gains, offsets, tip; after Harders), full, or auto: by cross-validation")
      .oneOf({"auto", "rigid", "joints", "harders", "full"})
      .showsDefault();
  command.option("--rig", o->rig, kBaseRigHelp).showsDefault();
  command.option("--held-out", o->held_out, "Touches outside the fit, to verify it").valueNamed("FILE");
  command.option("--region", o->region_mm3, "Volume that the case needs, mm3").from(0.0, 1e8);
  addMeasurementInfo(command, o->info);
  o->keep.addTo(command);
  command.flag("--json", o->json, "The fit as JSON on standard output");
  command.does([o] { return fit(*o); });
}

}  // namespace app
