// Runs the calibration wizard on the surgeon's display. Main thread. The stylus is a device, a practice stylus moved by
// mouse and keys, or the robot technician's; forces stay off. Esc, a closed window or an interrupt leaves without
// changes. The caller saves.
//   WizardRun run;
//   run.plan = {.procedure = …, .method = "jig27", .record = current, .device = {model, serial, mount, tip}};
//   haptics::OpenedDevice opened = haptics::openDevice(address, options);    run.device = opened.device.get();
//   or: run.practice = syntheticRig(Scenario::d, 7);  run.plan.record.rig = run.practice->nominal;  …device as there
//   const WizardOutcome outcome = runWizard(run);
//   if (outcome.end == WizardOutcome::End::accepted) store.keep(place, recordOf(run.plan, outcome), touches, true);
#pragma once

#include <filesystem>
#include <optional>

#include "app/calibrate/guided_procedure.h"
#include "app/calibrate/robot_technician.h"
#include "app/calibrate/wizard_outcome.h"

namespace app {

struct WizardRun : GuidedRun {
  WizardPlan plan;
  std::optional<TechnicianSettings> robot;  ///< holds the practice stylus instead of mouse and keys
  bool hurried = false;                     ///< the robot takes no more time than it needs to think
  bool tells = false;                       ///< reports what the pages say
  std::filesystem::path pages;              ///< a folder for a picture of each page; empty: none
};

/// Throws CalibrationError and UsageError for what cannot be run, haptics::DeviceError for a device that cannot be
/// listened to, render::GpuError without a display.
WizardOutcome runWizard(const WizardRun& run);

}  // namespace app
