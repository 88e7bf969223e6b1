// What is on the USB, read without opening a device: ids, location, classes, strings as the kernel read them. One
// UsbBus may be asked repeatedly, well under a millisecond each time after the first. One thread at a time; not the
// servo's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct libusb_context;
struct libusb_device;

namespace haptics {

/// As the kernel writes it: "bus-port.port…", "1-2.3"; of a root hub "usb1".
std::string usbPath(libusb_device* device);
/// "1234:0006".
std::string usbId(std::uint16_t vendor, std::uint16_t product);
/// First line of a sysfs attribute, "serial" or "product"; empty where there is none.
std::string usbAttribute(const std::string& path, const std::string& attribute);

struct UsbDevice {
  std::uint16_t vendor = 0, product = 0;
  std::string path;  ///< bus and ports, "1-2.3", as UsbAddress takes it
  std::string name, serial;
  std::uint8_t device_class = 0;
  std::vector<std::uint8_t> interface_classes;  ///< of the active configuration, in its order
  bool may_open = false;                        ///< this user may read and write it

  std::string id() const { return usbId(vendor, product); }
  /// "USB 1-2, 1234:0006".
  std::string location() const { return "USB " + path + ", " + id(); }
};

class UsbBus {
 public:
  /// Throws DeviceError when libusb does not start. A machine without USB is no error: there is nothing on it.
  UsbBus();
  ~UsbBus();
  UsbBus(const UsbBus&) = delete;
  UsbBus& operator=(const UsbBus&) = delete;

  /// In the order of their paths.
  std::vector<UsbDevice> devices() const;

 private:
  libusb_context* context_ = nullptr;
};

}  // namespace haptics
