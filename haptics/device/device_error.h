// Why a device cannot be opened or served: a line for people (what, where, what to do) and its kind for programs.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace haptics {

enum class DeviceTrouble : std::uint8_t {
  not_there,     ///< no such device is plugged in, or it has gone again
  no_rights,     ///< this user may not open it
  no_driver,     ///< its library or firmware is missing, incomplete or too old
  busy,          ///< another program, or another part of this one, uses it
  not_ready,     ///< not homed, or cancelled
  faulty,        ///< wrong or missing answers
  no_resources,  ///< the system is out of memory, descriptors or services
  bad_setting    ///< a rate, pose, mapping or parameter out of range
};

struct DeviceError : std::runtime_error {
  explicit DeviceError(const std::string& line, DeviceTrouble kind = DeviceTrouble::bad_setting)
      : std::runtime_error(line), trouble(kind) {}
  DeviceTrouble trouble;
};

}  // namespace haptics
