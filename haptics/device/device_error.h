// Why a device can not be had or served: a line for people, and its kind for programs. The line says what, where and
// what to do; nobody reads it to find the kind.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace haptics {

enum class DeviceTrouble : std::uint8_t {
  not_there,     ///< no such device is plugged in, or it has gone again
  no_rights,     ///< this user may not open it
  no_driver,     ///< what drives it is missing, incomplete or too old: library, firmware
  busy,          ///< another program or another part of this one has it
  not_ready,     ///< its owner has not homed it, or has given up
  faulty,        ///< it does not answer as it should
  no_resources,  ///< the system has no memory, descriptor or service left
  bad_setting    ///< a rate, pose, mapping or number with which it can not be served
};

struct DeviceError : std::runtime_error {
  explicit DeviceError(const std::string& line, DeviceTrouble kind = DeviceTrouble::bad_setting)
      : std::runtime_error(line), trouble(kind) {}
  DeviceTrouble trouble;
};

}  // namespace haptics
