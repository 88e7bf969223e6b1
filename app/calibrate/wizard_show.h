// The calibration wizard on the surgeon's display, from the first page to the outcome. Main thread. The stylus is a
// device's, a practice stylus's held by mouse and keys, or the robot technician's; forces stay off. Esc, a closed
// window or an interrupt leaves: nothing is changed then. Saves nothing: that is the caller's.
//   WizardRun run;
//   run.plan = {.procedure = …, .method = "jig27", .record = current, .device = {model, serial, mount, tip}};
//   haptics::OpenedDevice opened = haptics::openDevice(address, options);    run.device = opened.device.get();
//   or: run.practice = syntheticRig(Scenario::d, 7);  run.plan.record.rig = run.practice->nominal;  …device as there
//   const WizardOutcome outcome = runWizard(run);
//   if (outcome.end == WizardOutcome::End::accepted) store.keep(place, recordOf(run.plan, outcome), touches, true);
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/calibrate/robot_technician.h"
#include "app/calibrate/wizard_outcome.h"
#include "app/calibrate/wizard_screen.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "haptics/device/haptic_device.h"

namespace app {

struct WizardRun {
  WizardPlan plan;
  haptics::HapticDevice* device = nullptr;            ///< opened, not started; null: practice
  std::optional<calibration::SyntheticRig> practice;  ///< what is practised on, where there is no device
  std::optional<TechnicianHabits> robot;              ///< holds the practice stylus instead of mouse and keys
  bool hurried = false;                               ///< the robot takes no more time than it needs to think
  bool windows = true;                                ///< false: nothing is shown; the robot's only
  WizardDisplay display;
  std::filesystem::path pages;  ///< a folder for a picture of each page; empty: none
  bool sounds = true;
  std::function<void(const std::string& line)> tell = [](const std::string&) {};
  std::function<bool()> given_up = [] { return false; };  ///< asked many times a second: an interrupt
};

/// Throws CalibrationError and UsageError for what can not be run, haptics::DeviceError for a device that can not be
/// listened to, render::GpuError without a display.
WizardOutcome runWizard(const WizardRun& run);

}  // namespace app
