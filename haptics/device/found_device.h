// What a search for devices tells of one it found: for people, and for opening it. Plain data; any thread.
#pragma once

#include <string>

#include "haptics/device/haptic_device.h"

namespace haptics {

struct FoundDevice {
  std::string name;     ///< as people call it: "WoodenHaptics", "3D Systems Touch (HID)"
  std::string address;  ///< what `--device` takes to open it: "wooden:1-2"; empty: Molar does not drive it
  std::string place;    ///< where it hangs: "USB 1-2, 1234:0006", "OpenHaptics, default device"
  Provenance provenance = Provenance::public_protocol;
  std::string driver;  ///< what drives it, or would: "libusb", "OpenHaptics 3.5 by 3D Systems"
  std::string advice;  ///< the next step for its owner, one sentence; empty: it is ready
};

}  // namespace haptics
