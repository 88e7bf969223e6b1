// `molar calibrate rezero`: a rig brought up to date with five touches, after homing or a push.

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/calibrate/base_rig.h"
#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "calibration/fit/touches_file.h"

namespace app {
namespace {

using namespace calibration;

struct RezeroOptions {
  std::string rig, observations;
  Measuring measuring;
  KeepOption keep;
};

int rezero(const RezeroOptions& options) {
  options.keep.refuseUnlessWritable();
  const RigRecord base = baseRig(options.rig);
  const TouchSet touches = readTouches(options.observations);
  const Rezero done = rezeroed(armOf(base, touches, options.rig), touches);
  std::fputs(rezeroText(done).c_str(), stderr);

  // What is left at its own touches stands for the check until four others are touched.
  Measuring measuring = options.measuring;
  if (!base.provenance.rig_id.empty()) measuring.rig_id = base.provenance.rig_id;
  RigRecord record = rezeroedRig(base, done, measuring);
  prove(record, done.residuals, ProofKind::session_check);
  std::fputs(proofText(record.proof->errors, judge(record.proof->errors, ProofKind::session_check)).c_str(), stderr);
  options.keep.keep(record, touchesText(touches));
  return statusOf(record.proof->verdict);
}

}  // namespace

void addCalibrateRezero(CLI::App& calibrate, Chosen& chosen) {
  auto o = std::make_shared<RezeroOptions>();
  CLI::App* command = calibrate.add_subcommand("rezero", "Bring a rig up to date with five touches, 30 s");
  command->add_option("RIG", o->rig, kBaseRigHelp)->required();
  command->add_option("OBSERVATIONS", o->observations, "Touches, YAML")->required();
  addMeasuring(*command, o->measuring);
  o->keep.addTo(*command);
  command->callback([o, &chosen] { chosen.action = [o] { return rezero(*o); }; });
}

}  // namespace app
