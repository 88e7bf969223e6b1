// Opening a real device: what may be said about how, what one gets, and one function a back-end, in its own folder;
// device_catalogue has a line for each. Start-up only: a Falcon loads its program and waits to be homed, half a minute.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/device/haptic_device.h"
#include "haptics/device/openhaptics/hd_library.h"
#include "haptics/device/thread_priority.h"
#include "haptics/device/usb/falcon_force_scale.h"

namespace haptics {

struct DeviceOptions {
  std::filesystem::path falcon_program;  ///< its maker's firmware
  /// What a balance showed of this user's Falcon; asked when there is one to open.
  std::function<FalconForceScale()> falcon_scale = [] { return FalconForceScale(); };
  int servo_priority = kServoPriority;  ///< the thread that reads its USB lies next to it
  std::optional<bool> docked_value;  ///< OpenHaptics: what the inkwell's switch shows of a docked stylus; none: learned
  std::function<void(const std::string&)> tell = [](const std::string&) {};  ///< progress, and what a person shall do
  std::function<bool()> given_up = [] { return false; };                     ///< asked while it waits for a person
};

/// A device with what it rests on.
struct OpenedDevice {
  std::unique_ptr<HdLibrary> library;
  std::unique_ptr<HapticDevice> device;
  std::string address;
};

/// What the back-ends call while they wait for a person: says the same thing once; false: given up.
std::function<bool(const std::string& words)> waitPrompt(const DeviceOptions& options);

/// `place`: the address behind its scheme and colon. Throw DeviceError.
OpenedDevice openPhantom(const std::string& place, const DeviceOptions& options);
OpenedDevice openWooden(const std::string& place, const DeviceOptions& options);
OpenedDevice openFalcon(const std::string& place, const DeviceOptions& options);

}  // namespace haptics
