// `molar calibrate verify` and `check`: a rig against touches it has not seen; the check at the start of a session.

#include <cstdio>
#include <memory>

#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/fit/touch_checks.h"
#include "calibration/fit/touches_file.h"

namespace app {
namespace {

using namespace calibration;

struct VerifyOptions {
  std::string rig, observations;
  WizardOption wizard;
  MeasurementInfo info;
  KeepOption keep;
  bool session_check = false, json = false;
};

int verify(const VerifyOptions& options) {
  // With a device, a failed check is followed by a re-zero.
  if (options.wizard.isGiven())
    return conclude(
        options.wizard.guide(CalibrationProcedure::check, "check4", options.rig, options.keep.rigs(), options.info),
        options.keep);
  if (options.rig.empty() || options.observations.empty())
    throw UsageError(std::string("calibrate ") + (options.session_check ? "check" : "verify") +
                     ": it needs a rig and touches" + (options.session_check ? ", or a device (--device)" : ""));
  options.keep.refuseUnlessWritable();
  RigRecord record = baseRig(options.rig);
  const TouchSet touches = readTouches(options.observations);
  const MeasuredArm arm = armOf(record, touches, options.rig);
  const VerificationKind kind = options.session_check ? VerificationKind::session_check
                                : record.procedure    ? verificationKindOf(record.procedure->method)
                                                      : VerificationKind::full;
  const auto residuals = residualsOf(arm, touches.touches);
  checkUnseen(record.residuals, residuals, options.observations);
  const TargetErrors errors = targetErrors(residuals);
  const Assessment assessment = assess(errors, kind);

  std::fputs(verificationText(errors, assessment).c_str(), stderr);
  if (options.session_check && assessment.verdict != Verdict::green)
    std::fputs("molar: re-zero with five touches (molar calibrate rezero); if it stays so, calibrate anew\n", stderr);
  if (options.json) std::fputs(verificationJson(errors, assessment).c_str(), stdout);
  if (options.session_check) {
    options.keep.note(record, DriftKind::check, errors);
  } else {
    const RigRecord base = record;
    putVerification(record, residuals, kind);
    MeasurementInfo info;
    info.operator_code = base.provenance.operator_code;
    if (!base.provenance.rig_id.empty()) info.rig_id = base.provenance.rig_id;
    stamp(record, base, info);
    options.keep.keep(record, touchesText(touches));
    options.keep.note(record, assessment.verdict == Verdict::red ? DriftKind::check : DriftKind::calibration, errors);
  }
  return statusOf(assessment.verdict);
}

void addOne(CommandLine& calibrate, bool session_check) {
  auto o = std::make_shared<VerifyOptions>();
  o->session_check = session_check;
  CommandLine& command = session_check
                             ? calibrate.command("check", "Four touches at the start of a session: is it still right?")
                             : calibrate.command("verify", "A rig against touches it has not seen");
  command.option("RIG", o->rig, kBaseRigHelp);
  command.option("OBSERVATIONS", o->observations, "Touches, YAML");
  command.flag("--json", o->json, "Numbers as JSON on standard output");
  o->keep.addTo(command);
  if (session_check) {
    o->wizard.addTo(command);
    addMeasurementInfo(command, o->info);
  }
  command.does([o] { return verify(*o); });
}

}  // namespace

void addCalibrateVerification(CommandLine& calibrate) {
  addOne(calibrate, false);
  addOne(calibrate, true);
}

}  // namespace app
