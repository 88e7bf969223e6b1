// What moves the tool in a rehearsal: the device or simulation, where its frame stands to the patient, how its handle
// holds the tool, how long it runs by itself. Start-up only; the device then belongs to the workstation.
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
#include "haptics/device/simulated/led_hand.h"
#include "haptics/device/simulated/mouse_device.h"
#include "haptics/device/simulated/pose_list_device.h"
#include "haptics/loop/served_device.h"

namespace app {

using haptics::DeviceOptions;
using haptics::OpenedDevice;

/// A request in a pose file, as written: a tool of the tray, a control by its name.
struct TimedRequest {
  double t_s = 0.0;
  std::string tool, action;  ///< empty: none
  std::string where;         ///< file and line, for messages
};

struct PoseSource {
  std::unique_ptr<haptics::HdLibrary> library;  ///< that the device needs, if any
  std::unique_ptr<haptics::HapticDevice> device;
  std::string name;                       ///< for people, also in a recording
  haptics::MouseDevice* mouse = nullptr;  ///< set where the window moves it
  haptics::LedHand* led = nullptr;        ///< set where a procedure leads it, frame D is P
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;
  calibration::Pose<calibration::Handle, calibration::Tool> X_HT;
  bool held_by_end = false;                     ///< in a person's hand: haptics::LoopSettings
  std::optional<calibration::MeasuredArm> arm;  ///< corrects the sensors; none: the driver's pose stands
  std::optional<double> duration_s, rate_Hz;    ///< where it has its own
  std::vector<TimedRequest> requests;           ///< in the order of their times
};

/// Where the mouse's tool begins: in front of the site; the handpiece as planned for the cut or along the tooth of a
/// root-canal treatment or a preparation, else towards the viewer and down.
calibration::Pose<calibration::World, calibration::Tool> restingTool();
calibration::Pose<calibration::World, calibration::Tool> restingTool(const calibration::Rig& rig,
                                                                     const assets::Patient& patient,
                                                                     const std::optional<assets::PlannedCut>& cut);

/// For a device that measures no orientation: its tool keeps the rotation R_WT.
void fixOrientation(PoseSource& source, const calibration::Rig& rig, const glm::dquat& R_WT);

/// `cut`: for a scripted source. `opened`: the real device of the address, if it is open already. A measured arm of the
/// rig is this device's (rig_choice has checked). A device without orientation holds the tool as the mouse does. Throws
/// UsageError for an unknown address, without a cut for a scripted source, or when a simulated arm does not reach it;
/// haptics::DeviceError when a real one cannot be opened; SessionError for no recording.
PoseSource openPoseSource(const std::string& address, const DeviceOptions& options, const assets::Patient& patient,
                          const calibration::Rig& rig, const std::optional<assets::PlannedCut>& cut,
                          std::optional<OpenedDevice> opened = std::nullopt);

/// What a scripted hand does that was planned beforehand and feels nothing.
struct HandScript {
  std::vector<haptics::TimedHandlePose> poses;  ///< frame D is P, the handle is the tool
  std::vector<TimedRequest> requests;           ///< of the tools
};
PoseSource handAlong(HandScript script, const std::string& name);

/// Whether a device ticks on its own thread, by the clock, or is stepped: its time is then the ticks it is made to
/// make.
enum class Ticking { realtime, stepped };
/// Throws haptics::DeviceError for a device that cannot be stepped: a real one.
haptics::ServedDevice servedAs(haptics::HapticDevice& device, Ticking ticking);

}  // namespace app
