// The hand of a rehearsal: which device, where its frame stands to the patient, how its handle holds the tool, how long
// it works by itself. Start-up only; the device then belongs to the workstation.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "calibration/rig.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/opened_device.h"
#include "haptics/device/simulated/mouse_device.h"

namespace app {

using haptics::DeviceOptions;
using haptics::OpenedDevice;

/// What a hand asks for beside moving, as it is written: a tool of the tray, a control by its name.
struct TimedRequest {
  double t_s = 0.0;
  std::string tool, action;  ///< empty: nothing
  std::string where;         ///< it stands, for people
};

struct PoseSource {
  std::unique_ptr<haptics::HdLibrary> library;  ///< that the device rests on, if any
  std::unique_ptr<haptics::HapticDevice> device;
  std::string name;                       ///< as people read it in a recording
  haptics::MouseDevice* mouse = nullptr;  ///< set where the window moves the hand
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;
  calibration::Pose<calibration::Handle, calibration::Tool> X_HT;
  std::optional<calibration::MeasuredArm> arm;  ///< by which its sensors are read; none: as its driver has it
  std::optional<double> duration_s, rate_Hz;    ///< where the hand has its own
  std::vector<TimedRequest> asks;               ///< in the order of their times
};

/// Where the mouse's tool begins: in front of the site.
calibration::Pose<calibration::World, calibration::Tool> restingTool();

/// A rig with a measured arm is this device's (rig_choice has looked): of a Phantom its correction is the arm's and its
/// tip the tool's. `cut`: what a scripted hand takes. `opened`: the real device of the address, where it is open
/// already. Throws UsageError for no device at all, where there is no cut for a scripted hand, or a simulated arm does
/// not reach it; haptics::DeviceError when a real one can not be had; SessionError for no recording.
PoseSource openPoseSource(const std::string& address, const DeviceOptions& options, const assets::Patient& patient,
                          const calibration::Rig& rig, const std::optional<assets::PlannedCut>& cut,
                          std::optional<OpenedDevice> opened = std::nullopt);

}  // namespace app
