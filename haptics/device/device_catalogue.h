// Every device there is for a hand, a line each: its address, what drives it and what it was proved against, how it is
// found and how it is opened. A new back-end is a folder, its open… in opened_device and a line here. Searches open no
// device; they read files, ask libusb, and load the vendor's library to see whether it could be used. Any thread but
// the servo's.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/found_device.h"
#include "haptics/device/opened_device.h"

namespace haptics {

enum class Bus : std::uint8_t { none, library, usb, input };

struct DeviceKind {
  std::string_view key;        ///< the address begins with it …
  std::string_view place;      ///< … and may go on so, as help has it: "[:BUS-PORT]"
  std::string_view name;       ///< for people
  std::string_view driver;     ///< what drives it
  std::string_view proof;      ///< what it was run against
  Bus bus = Bus::none;         ///< none: there are no units of it in the world
  bool ran_on_a_unit = false;  ///< one was driven by this program
  std::vector<FoundDevice> (*find)() = nullptr;
  OpenedDevice (*open)(const std::string& place,
                       const DeviceOptions& options) = nullptr;  ///< null: no device with motors
  bool (*takes)(const std::string& place) = nullptr;             ///< whether an address may go on so; null: any way

  bool isHardware() const { return bus != Bus::none; }
};

std::span<const DeviceKind> deviceKinds();

struct DeviceCatalogue {
  std::vector<FoundDevice> devices;   ///< real ones first
  std::vector<DeviceError> troubles;  ///< of searches that failed
};

DeviceCatalogue findDevices();

/// An address that `openDevice` takes: of a kind that is opened, or "usb", the first of these on the USB.
bool isDeviceAddress(const std::string& address);
/// Throws DeviceError when it can not be had, for what is no such address too.
OpenedDevice openDevice(const std::string& address, const DeviceOptions& options);

}  // namespace haptics
