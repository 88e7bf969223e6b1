// Every device there is for a hand: the kinds Molar knows, with what each was proved against, and what is here now.
// Kinds are plain data. A search opens no device; it reads files, asks libusb, and loads the vendor's library to see
// whether it could be used. Any thread but the servo's.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/found_device.h"

namespace haptics {

struct DeviceKind {
  std::string_view key;        ///< the address begins with it
  std::string_view name;       ///< for people
  std::string_view driver;     ///< what drives it
  std::string_view proof;      ///< what it was run against
  bool is_hardware = false;    ///< there are units of it in the world …
  bool ran_on_a_unit = false;  ///< … and one of them was driven by this program
};

std::span<const DeviceKind> deviceKinds();

struct DeviceCatalogue {
  std::vector<FoundDevice> devices;   ///< real ones first
  std::vector<std::string> troubles;  ///< searches that failed, one line each
};

DeviceCatalogue findDevices();

}  // namespace haptics
