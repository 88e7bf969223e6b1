// Where a USB device hangs, as the kernel writes it ("1-2.3"), and what sysfs says of it without opening it. Start-up
// and searches only. Internal to haptics/device/usb.
#pragma once

#include <cstdint>
#include <string>

struct libusb_device;

namespace haptics {

/// "bus-port.port…"; of a root hub "usb1".
std::string usbPath(libusb_device* device);

/// "1234:0006".
std::string usbId(std::uint16_t vendor, std::uint16_t product);

/// One attribute's first line, "serial" or "product"; empty where there is none.
std::string usbAttribute(const std::string& path, const std::string& attribute);

}  // namespace haptics
