#include "haptics/device/usb/presence.h"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>
#include <utility>

#include "haptics/device/haptic_device.h"
#include "haptics/device/usb/usb_devices.h"

namespace haptics {
namespace {

/// The longest sleep, and the sleep while an arrived device is not listed yet.
constexpr timeval kIdle{1, 0}, kExpecting{0, 20'000};
/// How often an arrived device is searched for: it may have left again.
constexpr int kMaxSearches = 50;

}  // namespace

struct PresenceMonitor::Watch {
  explicit Watch(PresenceListener new_listener);
  ~Watch();

  static int onHotplug(libusb_context*, libusb_device* device, libusb_hotplug_event event, void* user);
  void run() noexcept;
  void noticeLeft(const std::string& path);
  void noticeArrived();

  PresenceListener listener;
  UsbBus bus;
  libusb_context* context = nullptr;
  std::atomic<bool> quit{false}, starved{false};

  // Of the watching thread.
  std::map<std::string, int> expected;  ///< path, and how often it was searched for
  std::map<std::string, PresentDevice> present;
  std::thread thread;
};

int PresenceMonitor::Watch::onHotplug(libusb_context*, libusb_device* device, libusb_hotplug_event event, void* user) {
  auto& watch = *static_cast<Watch*>(user);
  // No exception may pass through libusb.
  try {
    const std::string path = usbPath(device);
    if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT)
      watch.noticeLeft(path);
    else
      watch.expected[path] = 0;
  } catch (...) {
    watch.starved.store(true);
  }
  return 0;
}

PresenceMonitor::Watch::Watch(PresenceListener new_listener) : listener(std::move(new_listener)) {
  if (libusb_init(&context) != 0)
    throw DeviceError("USB: libusb does not start, look whether this user may read /dev/bus/usb",
                      DeviceTrouble::no_resources);
  const int events = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  const int error =
      libusb_hotplug_register_callback(context, events, LIBUSB_HOTPLUG_ENUMERATE, LIBUSB_HOTPLUG_MATCH_ANY,
                                       LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, onHotplug, this, nullptr);
  if (error != 0) {
    libusb_exit(context);
    throw DeviceError(std::string("USB: no hotplug events, ") + libusb_strerror(error) + ", start udev",
                      DeviceTrouble::no_resources);
  }
  thread = std::thread([this] { run(); });
}

PresenceMonitor::Watch::~Watch() {
  quit.store(true);
  libusb_interrupt_event_handler(context);
  thread.join();
  libusb_exit(context);
}

void PresenceMonitor::Watch::run() noexcept {
  try {
    while (!quit.load() && !starved.load()) {
      noticeArrived();
      timeval sleep = expected.empty() ? kIdle : kExpecting;
      libusb_handle_events_timeout_completed(context, &sleep, nullptr);
    }
  } catch (...) {
    starved.store(true);
  }
  if (starved.load() && listener.ended) listener.ended();
}

void PresenceMonitor::Watch::noticeLeft(const std::string& path) {
  expected.erase(path);
  const auto gone = present.extract(path);
  if (gone && listener.left) listener.left(gone.mapped());
}

void PresenceMonitor::Watch::noticeArrived() {
  if (expected.empty()) return;
  const std::vector<UsbDevice> devices = bus.devices();
  for (auto each = expected.begin(); each != expected.end();) {
    const auto& path = each->first;
    const auto found = std::find_if(devices.begin(), devices.end(), [&](const UsbDevice& d) { return d.path == path; });
    if (found == devices.end()) {
      each = ++each->second < kMaxSearches ? std::next(each) : expected.erase(each);
      continue;
    }
    if (const auto kind = knownAs(*found)) {
      const PresentDevice& arrival = present[path] = {*kind, described(*kind, *found)};
      if (listener.arrived) listener.arrived(arrival);
    }
    each = expected.erase(each);
  }
}

PresenceMonitor::PresenceMonitor(PresenceListener listener) : watch_(std::make_unique<Watch>(std::move(listener))) {}
PresenceMonitor::~PresenceMonitor() = default;

}  // namespace haptics
