// What is on the USB, without opening anything: ids, place, classes, strings as the kernel read them. For searches and
// for watching what comes and goes: one UsbBus may be asked again and again, which costs well under a millisecond, the
// first time some. One thread at a time; not the servo's.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace haptics {

struct UsbDevice {
  std::uint16_t vendor = 0, product = 0;
  std::string path;  ///< bus and ports, "1-2.3", as UsbAddress takes it
  std::string maker, name, serial;
  std::uint8_t device_class = 0;
  std::vector<std::uint8_t> interface_classes;  ///< of the active configuration, in its order
  bool may_open = false;                        ///< this user may read and write it

  /// "1234:0006".
  std::string id() const;
  /// "USB 1-2, 1234:0006".
  std::string place() const;
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
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace haptics
