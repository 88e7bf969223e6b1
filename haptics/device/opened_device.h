// Opening a real device: its options, the result, and one function a back-end, defined with its driver;
// device_catalogue has a line for each. Start-up only: a Falcon loads its firmware and waits to be homed, half a
// minute.
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
  /// The measured force scale of this user's Falcon; called only when one is opened.
  std::function<FalconForceScale()> falcon_scale = [] { return FalconForceScale(); };
  int servo_priority = kServoPriority;
  std::optional<bool> docked_value;  ///< OpenHaptics: what the inkwell switch reads when docked; none: learned
  std::function<void(const std::string&)> report = [](const std::string&) {};  ///< progress, and what the user must do
  std::function<bool()> is_cancelled = [] { return false; };                   ///< polled while it waits for the user
};

/// A device with the library it needs.
struct OpenedDevice {
  std::unique_ptr<HdLibrary> library;
  std::unique_ptr<HapticDevice> device;
  std::string address;
};

/// What a back-end calls while it waits for the user: reports repeated words once; false: cancelled.
inline std::function<bool(const std::string& words)> waitPrompt(const DeviceOptions& options) {
  return [report = options.report, is_cancelled = options.is_cancelled,
          last = std::string()](const std::string& words) mutable {
    if (words != last) report(words);
    last = words;
    return !is_cancelled();
  };
}

/// `rest`: the address after its scheme and colon. Throw DeviceError.
OpenedDevice openPhantom(const std::string& rest, const DeviceOptions& options);
OpenedDevice openWooden(const std::string& rest, const DeviceOptions& options);
OpenedDevice openFalcon(const std::string& rest, const DeviceOptions& options);

}  // namespace haptics
