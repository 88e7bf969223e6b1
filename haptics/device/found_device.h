// One result of a search for devices: for people, and for opening it. Plain data; any thread.
#pragma once

#include <string>

#include "haptics/device/haptic_device.h"

namespace haptics {

struct FoundDevice {
  std::string name;      ///< "WoodenHaptics", "3D Systems Touch (HID)"
  std::string address;   ///< what `--device` takes to open it: "wooden:1-2"; empty: Molar does not drive it
  std::string location;  ///< "USB 1-2, 1234:0006", "OpenHaptics, default device"
  Provenance provenance = Provenance::public_protocol;
  std::string driver;  ///< that drives it, or would: "libusb", "OpenHaptics 3.5 by 3D Systems"
  std::string advice;  ///< the next step for its owner, one sentence; empty: ready
};

}  // namespace haptics
