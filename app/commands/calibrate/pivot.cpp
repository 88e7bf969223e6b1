// `molar calibrate pivot`: the tip of a new bur, its end in one pit and the handle swung about it.

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

struct PivotOptions {
  std::string observations, rig;
  MeasurementInfo info;
  KeepOption keep;
  bool json = false;
};

std::vector<RawJoints> holdsOf(const TouchSet& touches) {
  std::vector<RawJoints> holds;
  for (const Touch& touch : touches.touches)
    if (touch.used) holds.push_back(touch.joints_rad);
  return holds;
}

/// The rig's name from the base, if it has one.
MeasurementInfo infoOf(const PivotOptions& options, const RigRecord& base) {
  MeasurementInfo info = options.info;
  if (!base.provenance.rig_id.empty()) info.rig_id = base.provenance.rig_id;
  return info;
}

int pivot(const PivotOptions& options) {
  const bool writes = options.keep.into_store || !options.keep.out.empty();
  if (writes && options.rig.empty())
    throw UsageError("calibrate pivot: a tip alone is no rig, name the rig it belongs to: --rig RIG");
  options.keep.refuseUnlessWritable();
  const TouchSet touches = readTouches(options.observations);
  const RigRecord base = options.rig.empty() ? RigRecord{} : baseRig(options.rig);
  const MeasuredArm arm = armOf(base, touches, options.rig);

  const Pivot found = fitPivot(arm.geometry, arm.correction, holdsOf(touches));
  std::fputs(pivotText(found, arm.correction.tip_H_mm).c_str(), stderr);
  if (options.json) std::fputs(pivotJson(found).c_str(), stdout);
  if (!writes) return 0;

  RigRecord record = base;
  if (!record.rig.device) record.rig.device = RigDevice{touches.device_model, touches.serial, touches.mount, ""};
  if (!options.info.serial.empty()) record.rig.device->serial = options.info.serial;
  putPivot(record, arm, found, options.info.stylus_tip);
  stamp(record, base, infoOf(options, base));
  std::fputs(
      "note: with another tip the verification no longer holds: touch pits that no fit has seen, molar calibrate "
      "verify\n",
      stderr);
  options.keep.keep(record, touchesText(touches));
  return 0;
}

}  // namespace

void addCalibratePivot(CommandLine& calibrate) {
  auto o = std::make_shared<PivotOptions>();
  CommandLine& command = calibrate.command(
      "pivot", "The tip of a new bur: its end in one pit, the handle swung to all sides, 12 touches or more");
  command.option("OBSERVATIONS", o->observations, "Touches in one pit, YAML; where it is does not matter").required();
  command.option("--rig", o->rig, std::string(kBaseRigHelp) + " [the arm as its model says]");
  addMeasurementInfo(command, o->info);
  o->keep.addTo(command);
  command.flag("--json", o->json, "What was found as JSON on standard output");
  command.does([o] { return pivot(*o); });
}

}  // namespace app
