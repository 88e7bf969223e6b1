// Every kind of device, one table line each: its address, its driver and what that was tested against, how it is found
// and opened. A new back-end is a folder, its `open…` in opened_device.h and a line here. A search opens no device: it
// reads files, queries libusb, and loads the vendor's library to see whether it can be used. Any thread but the
// servo's.
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
  std::string_view key;     ///< the address begins with it …
  std::string_view suffix;  ///< … and may continue so, as the help shows it: "[:BUS-PORT]"
  std::string_view name;
  std::string_view driver;
  std::string_view proof;      ///< what the driver was tested against
  Bus bus = Bus::none;         ///< none: no hardware
  bool ran_on_a_unit = false;  ///< this program has driven a real unit
  std::vector<FoundDevice> (*find)() = nullptr;
  OpenedDevice (*open)(const std::string& rest,
                       const DeviceOptions& options) = nullptr;  ///< null: no device with motors
  bool (*accepts)(const std::string& rest) = nullptr;            ///< the rest of an address; null: any

  bool isHardware() const { return bus != Bus::none; }
};

std::span<const DeviceKind> deviceKinds();

struct DeviceCatalogue {
  std::vector<FoundDevice> devices;   ///< real ones first
  std::vector<DeviceError> troubles;  ///< of searches that failed
};

DeviceCatalogue findDevices();

/// What follows the first colon of an address.
std::string addressRest(const std::string& address);

/// Whether `openDevice` takes this address: of a kind that can be opened, or "usb", the first device on the USB.
bool isDeviceAddress(const std::string& address);
/// Throws DeviceError when it cannot be opened, or for any other address.
OpenedDevice openDevice(const std::string& address, const DeviceOptions& options);

}  // namespace haptics
