// Watches haptic devices come and go on the USB, those that Molar drives and those that only their maker's library can:
// so that somebody is told which driver to install, and so that a unit that is pulled out of its socket stops the
// motors at once, whatever its library says. Only looks: it opens no device, claims none and writes to none. A thread
// of its own, which sleeps until libusb's hotplug wakes it; both calls come from there, for what is plugged in already
// too.
#pragma once

#include <functional>
#include <memory>

#include "haptics/device/usb/known_devices.h"

namespace haptics {

struct PresentDevice {
  KnownDevice kind = KnownDevice::touch_serial;
  FoundDevice found;
};

/// Must not throw, nor end the monitor. Each may be empty.
struct PresenceListener {
  std::function<void(const PresentDevice&)> arrived, left;
  std::function<void()> ended = {};  ///< once, as the last: memory ran out, nothing is noticed any more
};

class PresenceMonitor {
 public:
  /// Throws DeviceError when libusb does not start or knows no hotplug.
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
