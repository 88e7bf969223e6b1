// A device opened by the vendor's library, from initialisation to disabling, which happens exactly once, and its
// capabilities in N, mm, frame D. The library's stiffness is documented as "0 to 1" and used by its guide as N/mm,
// damping accordingly as N s/mm; both are limited to what users of these devices recommend (reference/devices 2, 4.3).
// Torque is not driven: the unit of its property is documented both as N m and mN m. The owner's thread, while the
// scheduler does not run.
#pragma once

#include <string>

#include "haptics/device/haptic_device.h"
#include "haptics/device/openhaptics/hd_library.h"

namespace haptics {

class HdSession {
 public:
  /// Empty configuration: the default device. Throws DeviceError with the library's error.
  HdSession(const HdFunctions& hd, const std::string& configuration);
  ~HdSession() { close(); }
  HdSession(const HdSession&) = delete;
  HdSession& operator=(const HdSession&) = delete;

  /// Disables the device, once.
  void close() noexcept;

  hd::DeviceId id() const { return id_; }
  const std::string& name() const { return name_; }

 private:
  const HdFunctions& hd_;
  std::string name_;
  hd::DeviceId id_;
  bool open_ = true;
};

struct HdDescription {
  DeviceCapabilities capabilities;
  hd::Enum calibration_styles = 0;
};

/// Of the current device. Throws DeviceError when it does not report its force.
HdDescription describe(const HdFunctions& hd);

}  // namespace haptics
