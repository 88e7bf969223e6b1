#include "haptics/device/usb/usb_paths.h"

#include <libusb-1.0/libusb.h>

#include <array>
#include <cstdio>
#include <fstream>

namespace haptics {

std::string usbPath(libusb_device* device) {
  std::array<std::uint8_t, 7> ports{};  // USB allows seven tiers
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  const std::string bus = std::to_string(libusb_get_bus_number(device));
  if (depth <= 0) return "usb" + bus;
  std::string path = bus;
  for (int i = 0; i < depth; ++i) path += (i == 0 ? "-" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
  return path;
}

std::string usbId(std::uint16_t vendor, std::uint16_t product) {
  std::array<char, 12> id{};
  std::snprintf(id.data(), id.size(), "%04x:%04x", vendor, product);
  return id.data();
}

std::string usbAttribute(const std::string& path, const std::string& attribute) {
  std::ifstream file("/sys/bus/usb/devices/" + path + "/" + attribute);
  std::string line;
  std::getline(file, line);
  return line;
}

}  // namespace haptics
