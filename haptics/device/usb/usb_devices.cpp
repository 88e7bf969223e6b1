#include "haptics/device/usb/usb_devices.h"

#include <libusb-1.0/libusb.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

bool mayOpen(libusb_device* device) {
  std::array<char, 64> node{};
  std::snprintf(node.data(), node.size(), "/dev/bus/usb/%03u/%03u", libusb_get_bus_number(device),
                libusb_get_device_address(device));
  return access(node.data(), R_OK | W_OK) == 0;
}

std::vector<std::uint8_t> interfaceClasses(libusb_device* device) {
  std::vector<std::uint8_t> classes;
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(device, &config) != 0) return classes;
  for (int i = 0; i < config->bNumInterfaces; ++i)
    if (config->interface[i].num_altsetting > 0) classes.push_back(config->interface[i].altsetting[0].bInterfaceClass);
  libusb_free_config_descriptor(config);
  return classes;
}

}  // namespace

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

UsbBus::UsbBus() {
  if (const int error = libusb_init(&context_); error != 0)
    throw DeviceError(std::string("USB: libusb does not start, ") + libusb_strerror(error) +
                          ", look whether this user may read /dev/bus/usb",
                      DeviceTrouble::no_resources);
}

UsbBus::~UsbBus() { libusb_exit(context_); }

std::vector<UsbDevice> UsbBus::devices() const {
  std::vector<UsbDevice> devices;
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context_, &list);
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor d{};
    if (libusb_get_device_descriptor(list[i], &d) != 0) continue;
    UsbDevice device;
    device.vendor = d.idVendor;
    device.product = d.idProduct;
    device.path = usbPath(list[i]);
    device.name = usbAttribute(device.path, "product");
    device.serial = usbAttribute(device.path, "serial");
    device.device_class = d.bDeviceClass;
    device.interface_classes = interfaceClasses(list[i]);
    device.may_open = mayOpen(list[i]);
    devices.push_back(std::move(device));
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  std::sort(devices.begin(), devices.end(), [](const UsbDevice& a, const UsbDevice& b) { return a.path < b.path; });
  return devices;
}

}  // namespace haptics
