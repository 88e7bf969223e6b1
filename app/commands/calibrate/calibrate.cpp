// `molar calibrate`: align hand and eye. Its parts are the other files of this folder.

#include "app/commands/calibrate/calibrate.h"

#include <cstdio>

#include "app/calibrate/calibration_text.h"
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

bool comesIntoForce(const RigRecord& record) { return record.proof && record.proof->verdict != Verdict::red; }

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
  command.flag("--keep", into_store, "Keep it in the store; in force from then on unless it is red or unproved");
  addStore(command, store);
  command.flag("--force", force, "Replace a file that exists");
}

void KeepOption::note(const RigRecord& record, DriftKind kind, const TargetErrors& errors) const {
  if (!into_store || (kind != DriftKind::check && !comesIntoForce(record))) return;
  appendHistory(rigs().historyPath(placeOf(record)), {nowUtc(), kind, errors.n, errors.rms_mm, errors.bias_mm});
}

RigPlace KeepOption::placeOf(const RigRecord& record) const {
  RigPlace place;
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
  const bool passes = comesIntoForce(record);
  const auto path = rigs().keep(placeOf(record), record, touches_text, passes);
  std::fprintf(stderr, "molar: kept as %s; %s\n", path.c_str(),
               passes         ? "in force from now on"
               : record.proof ? "red, so the one before stays in force"
                              : "not proved yet, so the one before stays in force: prove it with molar calibrate "
                                "verify --keep");
}

void addMeasuring(CommandLine& command, Measuring& measuring) {
  command.option("--rig-id", measuring.rig_id, "Name of the workstation").showsDefault();
  command.option("--mount", measuring.mount, "Side of the surgeon on which the device stands")
      .oneOf({"right", "left"})
      .showsDefault();
  command.option("--serial", measuring.serial, "Serial of the device [as the observations have it]");
  command.option("--tip", measuring.stylus_tip, "Which bur or stylus end is in the handle");
  command.option("--operator", measuring.operator_code, "A code for who measures, never a name");
}

namespace {

const TouchSet& touchesOf(const WizardOutcome& outcome) {
  return outcome.touches.touches.empty() ? outcome.zeroing : outcome.touches;
}

}  // namespace

int concluded(const WizardOption::Led& led, const KeepOption& keep) {
  const WizardOutcome& outcome = led.outcome;
  if (outcome.fit) std::fputs(fitText(*outcome.fit).c_str(), stderr);
  if (outcome.rezero) std::fputs(rezeroText(*outcome.rezero).c_str(), stderr);
  if (outcome.errors && outcome.judgement) std::fputs(proofText(*outcome.errors, *outcome.judgement).c_str(), stderr);
  if (outcome.end != WizardOutcome::End::accepted) return 1;

  RigRecord record = recordOf(led.plan, outcome);
  stamp(record, led.plan.record, led.measuring);
  if (const auto before = measuredArm(led.plan.record.rig); outcome.rezero && before)
    keep.note(record, DriftKind::rezero, targetErrors(residualsOf(*before, outcome.zeroing.touches)));
  else if (outcome.errors)
    keep.note(record, outcome.fit ? DriftKind::calibration : DriftKind::check, *outcome.errors);
  // A check that found all well changes nothing.
  if (outcome.arm || outcome.rest || outcome.screen) keep.keep(record, touchesText(touchesOf(outcome)));
  return outcome.judgement ? statusOf(outcome.judgement->verdict) : 0;
}

int concluded(const WebcamObservations& seen, const WebcamFit& fit, const RigRecord& before, const Measuring& measuring,
              const KeepOption& keep, const std::vector<Residual>& proof) {
  RigRecord record = before;
  record.rig.device = RigDevice{seen.sights.device_model, measuring.serial, measuring.mount, measuring.stylus_tip};
  putWebcamFit(record, fit);
  if (!proof.empty()) putProof(record, proof, ProofKind::full);
  stamp(record, before, measuring);
  std::fputs(webcamFitText(fit).c_str(), stderr);
  std::fputs(proofText(record.proof->errors, judge(record.proof->errors, ProofKind::full)).c_str(), stderr);
  keep.keep(record, webcamFileText(seen));
  keep.note(record, DriftKind::calibration, record.proof->errors);
  return statusOf(record.proof->verdict);
}

int statusOf(Verdict verdict) { return verdict == Verdict::green ? 0 : 1; }

void addCalibrate(CommandLine& molar) {
  CommandLine& calibrate = molar.command("calibrate", "Align hand and eye: measure, fit, prove, keep");
  calibrate.wantsCommand();
  addCalibrateSimulate(calibrate);
  addCalibrateCollect(calibrate);
  addCalibrateFit(calibrate);
  addCalibrateProofs(calibrate);
  addCalibrateRezero(calibrate);
  addCalibratePivot(calibrate);
  addCalibrateLens(calibrate);
  addCalibrateReport(calibrate);
  addCalibrateStore(calibrate);
}

}  // namespace app
