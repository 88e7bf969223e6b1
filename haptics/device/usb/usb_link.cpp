#include "haptics/device/usb/usb_link.h"

#include <libusb-1.0/libusb.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <utility>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/usb_devices.h"

namespace haptics {
namespace {

constexpr std::size_t kMaxDescriptors = 16;
/// Packets have at most 64 bytes at full speed, 1024 at high speed; higher bits are not size.
constexpr std::size_t kPacketMask = 0x7ff;

[[noreturn]] void refuse(const std::string& name, const std::string& what, int error) {
  const auto fail = [&](const char* text, DeviceTrouble trouble) { throw DeviceError(name + what + text, trouble); };
  if (error == LIBUSB_ERROR_ACCESS)
    fail("permission denied, install the udev rules that `molar doctor --udev-rules` prints and replug it",
         DeviceTrouble::no_rights);
  if (error == LIBUSB_ERROR_BUSY) fail("in use by another program or driver, close it", DeviceTrouble::busy);
  if (error == LIBUSB_ERROR_NO_DEVICE) fail("it was unplugged, plug it in and start again", DeviceTrouble::not_there);
  throw DeviceError(name + what + libusb_strerror(error) + ", replug it and start again",
                    error == LIBUSB_ERROR_NO_MEM ? DeviceTrouble::no_resources : DeviceTrouble::faulty);
}

}  // namespace

UsbLink::UsbLink(const UsbAddress& address, UsbClock clock) : clock_(clock), interface_(address.interface) {
  name_ = (address.called.empty() ? "" : address.called + ", ") + "USB " +
          (address.path.empty() ? "" : address.path + ", ") + usbId(address.vendor, address.product);
  try {
    if (const int error = libusb_init(&context_); error != 0)
      throw DeviceError(name_ + ": libusb, " + libusb_strerror(error) + ", replug it and start again",
                        DeviceTrouble::no_resources);
    open(address);
    findPipes();
    claim();
    serial_number_ = usbAttribute(path_, "serial");
    watchDescriptors();
  } catch (...) {
    close();
    throw;
  }
}

UsbLink::~UsbLink() { close(); }

void UsbLink::close() noexcept {
  if (handle_) libusb_close(handle_);
  for (Abandoned& left : abandoned_) libusb_free_transfer(left.transfer);
  if (context_) libusb_exit(context_);
}

void UsbLink::open(const UsbAddress& address) {
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context_, &list);
  int error = LIBUSB_ERROR_NOT_FOUND;
  for (ssize_t i = 0; i < count && !handle_; ++i) {
    libusb_device_descriptor d{};
    if (libusb_get_device_descriptor(list[i], &d) != 0 || d.idVendor != address.vendor ||
        d.idProduct != address.product)
      continue;
    const std::string path = usbPath(list[i]);
    if (!address.path.empty() && path != address.path) continue;
    error = libusb_open(list[i], &handle_);
    if (error == 0) path_ = path;
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  if (!handle_ && error == LIBUSB_ERROR_NOT_FOUND)
    throw DeviceError(name_ + ": not on the bus, plug it in and switch it on", DeviceTrouble::not_there);
  if (!handle_) refuse(name_, ": ", error);
}

void UsbLink::findPipes() {
  libusb_config_descriptor* config = nullptr;
  if (const int error = libusb_get_active_config_descriptor(libusb_get_device(handle_), &config); error != 0)
    refuse(name_, ": its descriptors cannot be read, ", error);
  for (int i = 0; i < config->bNumInterfaces; ++i) {
    const libusb_interface& candidate = config->interface[i];
    if (candidate.num_altsetting < 1 || candidate.altsetting[0].bInterfaceNumber != interface_) continue;
    for (int e = 0; e < candidate.altsetting[0].bNumEndpoints; ++e) {
      const libusb_endpoint_descriptor& endpoint = candidate.altsetting[0].endpoint[e];
      const auto type = static_cast<std::uint8_t>(endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK);
      if (type != LIBUSB_TRANSFER_TYPE_INTERRUPT && type != LIBUSB_TRANSFER_TYPE_BULK) continue;
      UsbPipe& pipe = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0 ? in_ : out_;
      if (pipe.packet_bytes == 0)
        pipe = {endpoint.bEndpointAddress, type, static_cast<std::size_t>(endpoint.wMaxPacketSize) & kPacketMask};
    }
  }
  libusb_free_config_descriptor(config);
  if (in_.packet_bytes == 0 || out_.packet_bytes == 0)
    throw DeviceError(name_ + ": interface " + std::to_string(interface_) +
                          " has no IN and OUT pipe of interrupt or bulk type, it is not the device it says it is",
                      DeviceTrouble::faulty);
}

void UsbLink::claim() {
  // Where detaching is not supported, the claim alone may succeed.
  libusb_set_auto_detach_kernel_driver(handle_, 1);
  int error = libusb_claim_interface(handle_, interface_);
  if (error != 0 && error != LIBUSB_ERROR_NO_DEVICE) {
    libusb_set_auto_detach_kernel_driver(handle_, 0);
    error = libusb_claim_interface(handle_, interface_);
  }
  if (error != 0) refuse(name_, ": it cannot be claimed, ", error);
}

void UsbLink::watchDescriptors() {
  const libusb_pollfd** list = libusb_get_pollfds(context_);
  if (!list)
    throw DeviceError(name_ + ": libusb gives no descriptor to wait for, replug it and start again",
                      DeviceTrouble::no_resources);
  for (const libusb_pollfd** each = list; *each && descriptors_.size() + 1 < kMaxDescriptors; ++each) {
    descriptors_.push_back((*each)->fd);
    descriptor_events_.push_back((*each)->events);
  }
  libusb_free_pollfds(list);
}

bool UsbLink::pump(std::int64_t deadline_ns, int wake_descriptor) noexcept {
  std::array<pollfd, kMaxDescriptors> polled{};
  nfds_t count = 0;
  for (; count < descriptors_.size(); ++count) polled[count] = {descriptors_[count], descriptor_events_[count], 0};
  if (wake_descriptor >= 0) polled[count++] = {wake_descriptor, POLLIN, 0};

  const std::int64_t left_ns = std::clamp<std::int64_t>(deadline_ns - clock_.now_ns(), 0,
                                                        std::min<std::int64_t>(1'000'000'000, clock_.maxSleep_ns()));
  const timespec left = timespecOf(left_ns);
  ppoll(polled.data(), count, &left, nullptr);

  timeval at_once{0, 0};
  const int error = libusb_handle_events_timeout_completed(context_, &at_once, nullptr);
  return error == 0 || error == LIBUSB_ERROR_INTERRUPTED || error == LIBUSB_ERROR_TIMEOUT;
}

bool UsbLink::clearHalt(const UsbPipe& pipe) noexcept { return libusb_clear_halt(handle_, pipe.endpoint) == 0; }

void UsbLink::abandon(libusb_transfer* transfer, std::vector<std::uint8_t> buffer) {
  abandoned_.push_back({transfer, std::move(buffer)});
}

}  // namespace haptics
