// `molar calibrate rezero`: a rig brought up to date with five touches, after homing or a push.

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/calibrate/base_rig.h"
#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/usage_error.h"
#include "calibration/fit/touches_file.h"

namespace app {
namespace {

using namespace calibration;

struct RezeroOptions {
  std::string rig, observations;
  WizardOption wizard;
  Measuring measuring;
  KeepOption keep;
};

int rezeroWithDevice(const RezeroOptions& asked) {
  RezeroOptions options = asked;
  const auto led =
      options.wizard.lead(Procedure::rezero, "rezero5", options.rig, options.keep.rigs(), options.measuring);
  return concluded(led, options.measuring, options.keep);
}

int rezero(const RezeroOptions& options) {
  if (options.wizard.isGiven()) return rezeroWithDevice(options);
  if (options.rig.empty() || options.observations.empty())
    throw UsageError("calibrate rezero: it needs a rig and touches, or a device (--device)");
  options.keep.refuseUnlessWritable();
  const RigRecord base = baseRig(options.rig);
  const TouchSet touches = readTouches(options.observations);
  const MeasuredArm before = armOf(base, touches, options.rig);
  const Rezero done = rezeroed(before, touches);
  std::fputs(rezeroText(done).c_str(), stderr);

  // What is left at its own touches stands for the check until four others are touched.
  RigRecord record = base;
  putRezero(record, touches, done, 0.0);
  putProof(record, done.residuals, ProofKind::session_check);
  Measuring measuring = options.measuring;
  if (!base.provenance.rig_id.empty()) measuring.rig_id = base.provenance.rig_id;
  stamp(record, base, measuring);
  std::fputs(proofText(record.proof->errors, judge(record.proof->errors, ProofKind::session_check)).c_str(), stderr);
  options.keep.note(record, DriftKind::rezero, targetErrors(residualsOf(before, touches.touches)));
  options.keep.keep(record, touchesText(touches));
  return statusOf(record.proof->verdict);
}

}  // namespace

void addCalibrateRezero(CLI::App& calibrate, Chosen& chosen) {
  auto o = std::make_shared<RezeroOptions>();
  CLI::App* command = calibrate.add_subcommand("rezero", "Bring a rig up to date with five touches, 30 s");
  command->add_option("RIG", o->rig, kBaseRigHelp);
  command->add_option("OBSERVATIONS", o->observations, "Touches, YAML");
  o->wizard.addTo(*command);
  addMeasuring(*command, o->measuring);
  o->keep.addTo(*command);
  command->callback([o, &chosen] { chosen.action = [o] { return rezero(*o); }; });
}

}  // namespace app
