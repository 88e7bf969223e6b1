#include "tests/haptics/usb/simulated_usb.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace simulated_usb {
namespace {

using Clock = std::chrono::steady_clock;

/// A host whose request cannot be answered yet sleeps briefly here, as on the kernel's wait queue.
constexpr auto kNothingYet = std::chrono::microseconds(200);

void push16(Bytes& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 0xff));
}

Bytes descriptors(const Description& d) {
  Bytes config_body{9, 4, 0, 0, static_cast<std::uint8_t>(d.endpoints.size()), d.interface_class, 0, 0, 0};
  if (d.interface_class == 3) {
    const Bytes hid{9, 0x21, 0x11, 0x01, 0, 1, 0x22, 34, 0};
    config_body.insert(config_body.end(), hid.begin(), hid.end());
  }
  for (const Endpoint& endpoint : d.endpoints) {
    const Bytes head{7, 5, endpoint.address, endpoint.type};
    config_body.insert(config_body.end(), head.begin(), head.end());
    push16(config_body, endpoint.packet_bytes);
    config_body.push_back(1);
  }
  Bytes all{18, 1, 0, 2, d.device_class, 0, 0, 64};
  push16(all, d.vendor);
  push16(all, d.product);
  const Bytes rest{0, 1, 1, 2, 3, 1};
  all.insert(all.end(), rest.begin(), rest.end());
  const Bytes config_head{9, 2};
  all.insert(all.end(), config_head.begin(), config_head.end());
  push16(all, static_cast<unsigned>(9 + config_body.size()));
  const Bytes config_rest{1, 1, 0, 0x80, 50};
  all.insert(all.end(), config_rest.begin(), config_rest.end());
  all.insert(all.end(), config_body.begin(), config_body.end());
  return all;
}

std::string hex(const Bytes& bytes) {
  std::string text;
  char two[3];
  for (std::uint8_t byte : bytes) {
    std::snprintf(two, sizeof two, "%02X", byte);
    text += two;
  }
  return text;
}

std::string node(const Description& d) {
  char path[32];
  std::snprintf(path, sizeof path, "bus/usb/001/%03d", d.number);
  return path;
}

/// umockdev's own format (umockdev's docs): path, node, udev properties, sysfs attributes.
std::string deviceFile(const Description& d) {
  const std::string all = hex(descriptors(d));
  char text[4096];
  std::snprintf(text, sizeof text,
                "P: /devices/pci0000:00/0000:00:14.0/usb1/1-%s\nN: %s=%s\nE: BUSNUM=001\nE: DEVNUM=%03d\n"
                "E: DEVNAME=/dev/%s\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: MAJOR=189\nE: MINOR=%d\n"
                "E: PRODUCT=%x/%x/100\nE: SUBSYSTEM=usb\nE: TYPE=%d/0/0\nA: bConfigurationValue=1\\n\n"
                "A: bDeviceClass=%02x\\n\nA: bNumConfigurations=1\\n\nA: bNumInterfaces= 1\\n\nA: busnum=1\\n\n"
                "A: devnum=%d\\n\nA: devpath=%s\\n\nA: idVendor=%04x\\n\nA: idProduct=%04x\\n\nA: speed=12\\n\n"
                "A: version= 2.00\\n\n",
                d.port.c_str(), node(d).c_str(), all.c_str(), d.number, node(d).c_str(), d.number - 1, d.vendor,
                d.product, d.device_class, d.device_class, d.number, d.port.c_str(), d.vendor, d.product);
  std::string file = text;
  if (!d.maker.empty()) file += "A: manufacturer=" + d.maker + "\\n\n";
  if (!d.name.empty()) file += "A: product=" + d.name + "\\n\n";
  if (!d.serial.empty()) file += "A: serial=" + d.serial + "\\n\n";
  return file + "H: descriptors=" + all + "\n\n";
}

struct Urb {
  UMockdevIoctlData* urb = nullptr;
  UMockdevIoctlData* buffer = nullptr;
  usbdevfs_urb head{};
};

template <class T>
void patch(UMockdevIoctlData* data, std::size_t offset, const T& value) {
  Bytes bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  umockdev_ioctl_data_update(data, offset, bytes.data(), static_cast<gint>(bytes.size()));
}

}  // namespace

/// One device on the bus: its model, its line, its queue of transfers.
struct Plug {
  Description description;
  Device* device = nullptr;
  Faults faults;
  bool gone = false;
  std::deque<Urb> waiting, done;
  UMockdevIoctlBase* handler = nullptr;
  Bus::Parts* parts = nullptr;

  void finish(const Urb& urb, int status, std::size_t moved) {
    patch(urb.urb, offsetof(usbdevfs_urb, status), status);
    patch(urb.urb, offsetof(usbdevfs_urb, actual_length), static_cast<int>(moved));
    done.push_back(urb);
  }
  void giveIn(const Urb& urb, const Bytes& said, std::size_t offset) {
    const std::size_t room = static_cast<std::size_t>(urb.head.buffer_length) - offset;
    const std::size_t moved = std::min(room, said.size());
    Bytes given(said.begin(), said.begin() + static_cast<std::ptrdiff_t>(moved));
    if (moved > 0) umockdev_ioctl_data_update(urb.buffer, offset, given.data(), static_cast<gint>(moved));
    finish(urb, said.size() > room ? -EOVERFLOW : 0, moved);
  }
  /// True when the transfer is over.
  bool serve(const Urb& urb, double t_s);
  bool serveControl(const Urb& urb, double t_s);
  void serveWaiting(double t_s) {
    for (std::size_t i = 0; i < waiting.size();) {
      const Urb urb = waiting[i];
      if (serve(urb, t_s))
        waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(i));
      else
        ++i;
    }
  }
  std::optional<int> answer(UMockdevIoctlClient* client);
  int submit(UMockdevIoctlData* argument);
  int discard(std::uint64_t address);
  int reap(UMockdevIoctlData* argument);
};

struct Bus::Parts {
  UMockdevTestbed* testbed = umockdev_testbed_new();
  std::mutex mutex;
  Clock::time_point began = Clock::now();
  std::map<std::string, std::unique_ptr<Plug>> plugs;
  std::vector<std::unique_ptr<Plug>> unplugged;  ///< handles may still be open
  std::atomic<int> halts_cleared{0}, cancelled{0}, looks{0};

  std::optional<Clock::time_point> held;

  double now_s() const { return std::chrono::duration<double>(held.value_or(Clock::now()) - began).count(); }
  static std::string sysPath(const std::string& port) { return "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-" + port; }
};

bool Plug::serveControl(const Urb& urb, double t_s) {
  const auto* raw = urb.buffer->data;
  const Setup setup{raw[0], raw[1], static_cast<std::uint16_t>(raw[2] | raw[3] << 8),
                    static_cast<std::uint16_t>(raw[4] | raw[5] << 8)};
  const std::size_t size = static_cast<std::size_t>(urb.head.buffer_length) - 8;
  const bool comes_in = (setup.type & 0x80) != 0;
  const auto said = device->onControl(setup, {raw + 8, comes_in ? 0 : size}, t_s);
  if (!said)
    finish(urb, -EPIPE, 0);
  else if (comes_in)
    giveIn(urb, *said, 8);
  else
    finish(urb, 0, size);
  return true;
}

bool Plug::serve(const Urb& urb, double t_s) {
  if (faults.stuck) return false;
  if (faults.errors) return finish(urb, -EPROTO, 0), true;
  if (urb.head.type == USBDEVFS_URB_TYPE_CONTROL) return serveControl(urb, t_s);
  if ((urb.head.endpoint & 0x80) != 0) {
    if (faults.in_halted) return finish(urb, -EPIPE, 0), true;
    if (faults.in_silent) return false;
    const auto said = device->onIn(urb.head.endpoint, t_s);
    if (!said) return false;
    giveIn(urb, *said, 0);
    return true;
  }
  if (faults.out_halted) return finish(urb, -EPIPE, 0), true;
  if (faults.out_refused) return false;
  const auto size = static_cast<std::size_t>(urb.head.buffer_length);
  device->onOut(urb.head.endpoint, {size > 0 ? urb.buffer->data : nullptr, size}, t_s);
  finish(urb, 0, size);
  return true;
}

int Plug::submit(UMockdevIoctlData* argument) {
  Urb urb;
  urb.urb = umockdev_ioctl_data_ref(umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr));
  std::memcpy(&urb.head, urb.urb->data, sizeof urb.head);
  if (urb.head.buffer_length > 0)
    urb.buffer = umockdev_ioctl_data_ref(umockdev_ioctl_data_resolve(
        urb.urb, offsetof(usbdevfs_urb, buffer), static_cast<std::size_t>(urb.head.buffer_length), nullptr));
  const double t_s = parts->now_s();
  if (!serve(urb, t_s)) waiting.push_back(urb);
  return 0;
}

int Plug::discard(std::uint64_t address) {
  parts->cancelled.fetch_add(1);
  if (faults.stuck) return 0;
  for (auto urb = waiting.begin(); urb != waiting.end(); ++urb) {
    if (urb->urb->client_addr != address) continue;
    finish(*urb, -ENOENT, 0);
    waiting.erase(urb);
    return 0;
  }
  return -EINVAL;
}

int Plug::reap(UMockdevIoctlData* argument) {
  parts->looks.fetch_add(1);
  if (gone) {
    for (const Urb& urb : waiting) finish(urb, -ESHUTDOWN, 0);
    waiting.clear();
  } else {
    device->onTime(parts->now_s());
    serveWaiting(parts->now_s());
  }
  if (done.empty()) return gone ? -ENODEV : -EAGAIN;
  UMockdevIoctlData* slot = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
  umockdev_ioctl_data_set_ptr(slot, 0, done.front().urb);
  done.pop_front();
  return 0;
}

/// What usbfs answers: 0 or a negative errno.
std::optional<int> Plug::answer(UMockdevIoctlClient* client) {
  UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
  const unsigned long request = umockdev_ioctl_client_get_request(client);
  if (faults.handle_dead) return -ENOTTY;
  switch (request) {
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      return reap(argument);
    case USBDEVFS_DISCARDURB: {
      std::uint64_t address = 0;
      std::memcpy(&address, argument->data, sizeof address);
      return discard(address);
    }
    default:
      break;
  }
  if (gone) return -ENODEV;
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES: {
      const std::uint32_t capabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                         USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                         USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      patch(umockdev_ioctl_data_resolve(argument, 0, sizeof capabilities, nullptr), 0, capabilities);
      return 0;
    }
    case USBDEVFS_DISCONNECT_CLAIM:
      if (faults.detach_unserved) return -ENOTTY;
      return faults.claim_refused ? -EBUSY : 0;
    case USBDEVFS_CLAIMINTERFACE:
      return faults.claim_refused ? -EBUSY : 0;
    case USBDEVFS_RELEASEINTERFACE:
    case USBDEVFS_SETINTERFACE:
      return 0;
    case USBDEVFS_CLEAR_HALT:
      parts->halts_cleared.fetch_add(1);
      if (!faults.halts_stay) faults.in_halted = faults.out_halted = false;
      return 0;
    case USBDEVFS_GETDRIVER:
      return -ENODATA;
    case USBDEVFS_IOCTL:
      return faults.detach_unserved ? -ENOTTY : -ENODATA;
    case USBDEVFS_SUBMITURB:
      return submit(argument);
    default:
      return -ENOTTY;
  }
}

namespace {

gboolean onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer plug) {
  auto* self = static_cast<Plug*>(plug);
  int result = 0;
  {
    const std::lock_guard lock(self->parts->mutex);
    result = self->answer(client).value_or(0);
  }
  if (result == -EAGAIN) std::this_thread::sleep_for(kNothingYet);
  umockdev_ioctl_client_complete(client, result < 0 ? -1 : 0, result < 0 ? -result : 0);
  return TRUE;
}

}  // namespace

bool Bus::available() {
  const char* preloaded = std::getenv("LD_PRELOAD");
  return preloaded && std::strstr(preloaded, "umockdev") != nullptr;
}

Bus::Bus() : parts_(std::make_unique<Parts>()) {}

Bus::~Bus() {
  for (auto& [port, plug] : parts_->plugs)
    umockdev_testbed_detach_ioctl(parts_->testbed, ("/dev/" + node(plug->description)).c_str(), nullptr);
  g_object_unref(parts_->testbed);
}

void Bus::plug(const Description& description, Device& device) {
  auto plug = std::make_unique<Plug>();
  plug->description = description;
  plug->device = &device;
  plug->parts = parts_.get();
  plug->handler = umockdev_ioctl_base_new();
  g_signal_connect(plug->handler, "handle-ioctl", G_CALLBACK(onIoctl), plug.get());
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(parts_->testbed, deviceFile(description).c_str(), &error) ||
      !umockdev_testbed_attach_ioctl(parts_->testbed, ("/dev/" + node(description)).c_str(), plug->handler, &error))
    throw std::runtime_error(std::string("umockdev: ") + error->message);
  {
    const std::lock_guard lock(parts_->mutex);
    parts_->plugs[description.port] = std::move(plug);
  }
  umockdev_testbed_uevent(parts_->testbed, Parts::sysPath(description.port).c_str(), "add");
}

void Bus::unplug(const std::string& port) {
  {
    const std::lock_guard lock(parts_->mutex);
    auto found = parts_->plugs.extract(port);
    found.mapped()->gone = true;
    parts_->unplugged.push_back(std::move(found.mapped()));
  }
  umockdev_testbed_uevent(parts_->testbed, Parts::sysPath(port).c_str(), "remove");
  umockdev_testbed_remove_device(parts_->testbed, Parts::sysPath(port).c_str());
}

void Bus::set(const Faults& faults, const std::string& port) {
  const std::lock_guard lock(parts_->mutex);
  parts_->plugs.at(port)->faults = faults;
}

void Bus::holdTime() {
  const std::lock_guard lock(parts_->mutex);
  parts_->held = Clock::now();
}

void Bus::letTimePass() {
  const std::lock_guard lock(parts_->mutex);
  parts_->began += Clock::now() - parts_->held.value();
  parts_->held.reset();
}

void Bus::locked(const std::function<void()>& look) {
  const std::lock_guard lock(parts_->mutex);
  look();
}

int Bus::halts_cleared() const { return parts_->halts_cleared.load(); }
int Bus::cancelled() const { return parts_->cancelled.load(); }
int Bus::looks() const { return parts_->looks.load(); }

}  // namespace simulated_usb
