// An open and claimed USB interface with its IN and OUT pipes, and the handling of libusb's events. Internal to the
// transport. pump(): one thread at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/device/usb/usb_clock.h"
#include "haptics/device/usb/usb_transport.h"

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

namespace haptics {

struct UsbPipe {
  std::uint8_t endpoint = 0;
  std::uint8_t transfer_type = 0;  ///< libusb_transfer_type
  std::size_t packet_bytes = 0;
};

class UsbLink {
 public:
  UsbLink(const UsbAddress& address, UsbClock clock);
  ~UsbLink();
  UsbLink(const UsbLink&) = delete;
  UsbLink& operator=(const UsbLink&) = delete;

  libusb_device_handle* handle() const { return handle_; }
  const UsbClock& clock() const { return clock_; }
  const UsbPipe& in() const { return in_; }
  const UsbPipe& out() const { return out_; }
  const std::string& path() const { return path_; }
  const std::string& serialNumber() const { return serial_number_; }

  /// Sleeps until libusb has an event, `wake_descriptor` (or -1) is readable or the deadline, then runs libusb's
  /// callbacks. False: libusb failed, the handle is dead.
  bool pump(std::int64_t deadline_ns, int wake_descriptor) noexcept;

  /// Blocks as long as the kernel does. False: refused, or the device is gone.
  bool clearHalt(const UsbPipe& pipe) noexcept;

  /// Serial number of a completed transfer.
  std::uint64_t numberDone() noexcept { return ++done_; }

  /// Keeps a transfer that did not complete, with its buffer, until the handle is closed.
  void abandon(libusb_transfer* transfer, std::vector<std::uint8_t> buffer);

 private:
  struct Abandoned {
    libusb_transfer* transfer;
    std::vector<std::uint8_t> buffer;
  };

  void open(const UsbAddress& address);
  void claim();
  void findPipes();
  void watchDescriptors();
  void close() noexcept;

  UsbClock clock_;
  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
  int interface_;
  UsbPipe in_, out_;
  std::string name_, path_, serial_number_;
  std::vector<int> descriptors_;
  std::vector<short> descriptor_events_;
  std::vector<Abandoned> abandoned_;
  std::uint64_t done_ = 0;
};

}  // namespace haptics
