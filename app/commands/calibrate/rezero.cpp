// `molar calibrate rezero`: a rig brought up to date with five touches, after homing or a push.

#include <cstdio>
#include <memory>

#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/fit/touches_file.h"

namespace app {
namespace {

using namespace calibration;

struct RezeroOptions {
  std::string rig, observations, held_out;
  WizardOption wizard;
  MeasurementInfo info;
  KeepOption keep;
};

int rezero(const RezeroOptions& options) {
  if (options.wizard.isGiven())
    return conclude(
        options.wizard.guide(CalibrationProcedure::rezero, "rezero5", options.rig, options.keep.rigs(), options.info),
        options.keep);
  if (options.rig.empty() || options.observations.empty())
    throw UsageError("calibrate rezero: it needs a rig and touches, or a device (--device)");
  options.keep.refuseUnlessWritable();
  const RigRecord base = baseRig(options.rig);
  const TouchSet touches = readTouches(options.observations);
  const MeasuredArm before = armOf(base, touches, options.rig);
  const Rezero done = rezeroed(before, touches);
  std::fputs(rezeroText(done).c_str(), stderr);

  RigRecord record = base;
  putRezero(record, touches, done, 0.0);
  if (!options.held_out.empty()) {
    const TouchSet others = readTouches(options.held_out);
    armOf(base, others, options.rig);
    putVerification(record, residualsOf(done.arm, others.touches), VerificationKind::session_check);
    std::fputs(verificationText(record.verification->errors,
                                assess(record.verification->errors, VerificationKind::session_check))
                   .c_str(),
               stderr);
  }
  MeasurementInfo info = options.info;
  if (!base.provenance.rig_id.empty()) info.rig_id = base.provenance.rig_id;
  stamp(record, base, info);
  options.keep.keep(record, touchesText(touches));
  options.keep.note(record, DriftKind::rezero, targetErrors(residualsOf(before, touches.touches)));
  // Without held-out touches, the residuals of its own touches decide.
  return statusOf(record.verification ? record.verification->verdict
                                      : assess(targetErrors(done.residuals), VerificationKind::session_check).verdict);
}

}  // namespace

void addCalibrateRezero(CommandLine& calibrate) {
  auto o = std::make_shared<RezeroOptions>();
  CommandLine& command = calibrate.command("rezero", "Bring a rig up to date with five touches, 30 s");
  command.option("RIG", o->rig, kBaseRigHelp);
  command.option("OBSERVATIONS", o->observations, "Touches, YAML");
  command.option("--held-out", o->held_out, "Four more touches, to verify it").valueNamed("FILE");
  o->wizard.addTo(command);
  addMeasurementInfo(command, o->info);
  o->keep.addTo(command);
  command.does([o] { return rezero(*o); });
}

}  // namespace app
