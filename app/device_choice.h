// Opens the real device of an address, as `molar devices` lists them: `openhaptics[:NAME]` a Phantom or Touch by its
// maker's library, NAME as the vendor's set-up calls it; `wooden[:BUS-PORT]`, `wooden-v2015[:BUS-PORT]` and
// `falcon[:BUS-PORT]` on the USB; `usb` the first of these that is there. Start-up only: a Falcon loads its program and
// waits to be homed, half a minute.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/device/haptic_device.h"
#include "haptics/device/openhaptics/hd_library.h"
#include "haptics/device/usb/falcon_force_scale.h"

namespace app {

struct DeviceOptions {
  std::filesystem::path falcon_program;  ///< its maker's firmware
  haptics::FalconForceScale falcon_scale;
  std::optional<bool> docked_value;  ///< OpenHaptics: what the inkwell's switch shows of a docked stylus; none: learned
  std::function<void(const std::string&)> tell = [](const std::string&) {};  ///< progress, and what a person shall do
  std::function<bool()> given_up = [] { return false; };                     ///< asked while it waits for a person
};

/// A device with what it rests on.
struct OpenedDevice {
  std::unique_ptr<haptics::HdLibrary> library;
  std::unique_ptr<haptics::HapticDevice> device;
  std::string address;
};

/// False for mouse, script, simulated and replay, and for what is no address at all.
bool namesRealDevice(const std::string& address);

/// Throws haptics::DeviceError when it can not be had, UsageError for no address of a real device.
OpenedDevice openDevice(const std::string& address, const DeviceOptions& options);

}  // namespace app
