// Reports haptic devices that come and go on the USB, both those that Molar drives and those that need their maker's
// library: to name the missing driver, and to stop the motors of an unplugged unit at once. It opens no device and
// writes to none. A thread of its own sleeps until libusb's hotplug wakes it and calls the listener, also for what is
// plugged in at the start.
#pragma once

#include <functional>
#include <memory>

#include "haptics/device/usb/known_devices.h"

namespace haptics {

struct PresentDevice {
  KnownDevice kind = KnownDevice::touch_serial;
  FoundDevice found;
};

/// Must not throw, nor destroy the monitor. Each may be empty.
struct PresenceListener {
  std::function<void(const PresentDevice&)> arrived, left;
  std::function<void()> ended = {};  ///< once, last: out of memory, monitoring has ended
};

class PresenceMonitor {
 public:
  /// Throws DeviceError when libusb does not start or has no hotplug.
  explicit PresenceMonitor(PresenceListener listener);
  /// No call after it.
  ~PresenceMonitor();
  PresenceMonitor(const PresenceMonitor&) = delete;
  PresenceMonitor& operator=(const PresenceMonitor&) = delete;

 private:
  struct Watch;
  std::unique_ptr<Watch> watch_;
};

}  // namespace haptics
