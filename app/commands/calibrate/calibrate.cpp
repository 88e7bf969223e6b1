// `molar calibrate`: align hand and eye. Its parts are the other files of this folder.

#include "app/commands/calibrate/calibrate.h"

#include <cstdio>

#include "app/calibrate/calibration_text.h"
#include "app/case/patient_placement.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/fit/touches_file.h"
#include "calibration/output_file.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/utc.h"
#include "calibration/webcam/webcam_file.h"

namespace app {

using namespace calibration;

namespace {

bool becomesCurrent(const RigRecord& record) {
  return record.verification && record.verification->verdict != Verdict::red;
}

}  // namespace

void addStore(CommandLine& command, std::string& store) {
  command.option("--store", store, "Folder of the store [$MOLAR_CALIBRATION or the user's data folder]")
      .valueNamed("DIR");
}

RigStore storeAt(const std::string& folder) {
  return RigStore(folder.empty() ? RigStore::usualRoot() : std::filesystem::path(folder));
}

void KeepOption::addTo(CommandLine& command) {
  command.option("--out", out, "Rig file to write").valueNamed("FILE");
  command.flag("--keep", into_store, "Keep it in the store; in force from then on unless it is red or unverified");
  addStore(command, store);
  command.flag("--force", force, "Replace a file that exists");
}

void KeepOption::note(const RigRecord& record, DriftKind kind, const TargetErrors& errors) const {
  if (!into_store || (kind != DriftKind::check && !becomesCurrent(record))) return;
  appendHistory(rigs().historyPath(placeOf(record)), {nowUtc(), kind, errors.n, errors.rms_mm, errors.bias_mm});
}

RigLocation KeepOption::placeOf(const RigRecord& record) const {
  RigLocation place;
  if (!record.provenance.rig_id.empty()) place.rig_id = record.provenance.rig_id;
  if (record.rig.device) {
    place.serial = record.rig.device->serial;
    if (!record.rig.device->mount.empty()) place.mount = record.rig.device->mount;
  }
  return place;
}

void KeepOption::refuseUnlessWritable() const {
  if (!out.empty()) calibration::OutputFile claim(out, force);
}

void KeepOption::keep(const RigRecord& record, const std::string& touches_text) const {
  if (!out.empty()) {
    calibration::OutputFile file(out, force);
    file.commit(rigRecordText(record));
  }
  if (!into_store) return;
  const bool passes = becomesCurrent(record);
  const auto path = rigs().keep(placeOf(record), record, touches_text, passes);
  std::fprintf(stderr, "molar: kept as %s; %s\n", path.c_str(),
               passes ? "in force from now on"
               : record.verification
                   ? "red, so the one before stays in force"
                   : "not verified yet, so the one before stays in force: verify it with molar calibrate "
                     "verify --keep");
}

void addMeasurementInfo(CommandLine& command, MeasurementInfo& info) {
  command.option("--rig-id", info.rig_id, "Name of the workstation").showsDefault();
  command.option("--mount", info.mount, "Side of the surgeon on which the device stands")
      .oneOf({"right", "left"})
      .showsDefault();
  command
      .option(
          "--position", info.patient_position,
          "Where the surgeon sits, for which hand rest and head are set up; rehearse takes it from the rig [as before]")
      .oneOf({kPatientPositions.begin(), kPatientPositions.end()});
  command.option("--serial", info.serial, "Serial of the device [as the observations have it]");
  command.option("--tip", info.stylus_tip, "Which bur or stylus end is in the handle");
  command.option("--operator", info.operator_code, "A code for who measures, never a name");
}

namespace {

const TouchSet& touchesOf(const WizardOutcome& outcome) {
  return outcome.touches.touches.empty() ? outcome.zeroing : outcome.touches;
}

}  // namespace

int conclude(const WizardOption::GuidedOutcome& led, const KeepOption& keep) {
  const WizardOutcome& outcome = led.outcome;
  if (outcome.fit) std::fputs(fitText(*outcome.fit).c_str(), stderr);
  if (outcome.rezero) std::fputs(rezeroText(*outcome.rezero).c_str(), stderr);
  if (outcome.errors && outcome.assessment)
    std::fputs(verificationText(*outcome.errors, *outcome.assessment).c_str(), stderr);
  if (outcome.end != WizardOutcome::End::accepted) return 1;

  RigRecord record = recordOf(led.plan, outcome);
  stamp(record, led.plan.record, led.info);
  if (const auto before = measuredArm(led.plan.record.rig); outcome.rezero && before)
    keep.note(record, DriftKind::rezero, targetErrors(residualsOf(*before, outcome.zeroing.touches)));
  else if (outcome.errors)
    keep.note(record, outcome.fit ? DriftKind::calibration : DriftKind::check, *outcome.errors);
  // A green check changes nothing.
  if (outcome.arm || outcome.rest || outcome.screen) keep.keep(record, touchesText(touchesOf(outcome)));
  return outcome.assessment ? statusOf(outcome.assessment->verdict) : 0;
}

int conclude(const WebcamObservations& seen, const WebcamFit& fit, const RigRecord& before, const MeasurementInfo& info,
             const KeepOption& keep, const std::vector<Residual>& verification) {
  RigRecord record = before;
  record.rig.device = RigDevice{seen.device_model, info.serial, info.mount, info.stylus_tip};
  putWebcamFit(record, fit);
  if (!verification.empty()) putVerification(record, verification, VerificationKind::full);
  stamp(record, before, info);
  std::fputs(webcamFitText(fit).c_str(), stderr);
  std::fputs(verificationText(record.verification->errors, assess(record.verification->errors, VerificationKind::full))
                 .c_str(),
             stderr);
  keep.keep(record, webcamFileText(seen));
  keep.note(record, DriftKind::calibration, record.verification->errors);
  return statusOf(record.verification->verdict);
}

int statusOf(Verdict verdict) { return verdict == Verdict::green ? 0 : 1; }

void addCalibrate(CommandLine& molar) {
  CommandLine& calibrate = molar.command("calibrate", "Align hand and eye: measure, fit, verify, keep");
  calibrate.requireCommand();
  addCalibrateSimulate(calibrate);
  addCalibrateCollect(calibrate);
  addCalibrateFit(calibrate);
  addCalibrateVerification(calibrate);
  addCalibrateRezero(calibrate);
  addCalibratePivot(calibrate);
  addCalibrateLens(calibrate);
  addCalibrateReport(calibrate);
  addCalibrateStore(calibrate);
}

}  // namespace app
