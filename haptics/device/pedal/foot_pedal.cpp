#include "haptics/device/pedal/foot_pedal.h"

#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

constexpr int kSearchInterval_ms = 500;
/// Reported when nothing can be allocated: its memory is reserved at construction.
constexpr std::string_view kOutOfMemory =
    "the pedal is read no more, memory or handles ran out: close other programs and start again";

/// With the ranges of its axes; without those that the device lacks.
std::vector<PedalSwitch> switchesOn(const libevdev* device, std::vector<PedalSwitch> switches) {
  std::erase_if(switches, [&](const PedalSwitch& one) {
    return !libevdev_has_event_code(device, one.is_axis ? EV_ABS : EV_KEY, one.code);
  });
  for (PedalSwitch& one : switches)
    if (one.is_axis) {
      one.min = libevdev_get_abs_minimum(device, one.code);
      one.max = libevdev_get_abs_maximum(device, one.code);
    }
  return switches;
}

}  // namespace

/// One device while it is open.
class FootPedal::Reading {
 public:
  static std::unique_ptr<Reading> of(const FoundPedal& pedal, const std::vector<PedalSwitch>& chosen) {
    const int fd = open(pedal.path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return {};
    libevdev* device = nullptr;
    if (libevdev_new_from_fd(fd, &device) < 0) {
      close(fd);
      return {};
    }
    return std::unique_ptr<Reading>(new Reading(fd, device, pedal, chosen));
  }
  ~Reading() {
    device_.reset();
    close(fd_);
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  int fd() const { return fd_; }
  HandActions held() const { return switches_.held(); }
  bool hasSwitches() const { return has_switches_; }

  /// Reads all pending events; false when the device is gone.
  bool read() {
    input_event event{};
    unsigned mode = LIBEVDEV_READ_FLAG_NORMAL;
    for (;;) {
      const int status = libevdev_next_event(device_.get(), mode, &event);
      if (status == -EAGAIN && mode == LIBEVDEV_READ_FLAG_SYNC) {
        mode = LIBEVDEV_READ_FLAG_NORMAL;
        continue;
      }
      if (status < 0) return status == -EAGAIN;
      // Events were lost: libevdev reports the changes since.
      if (status == LIBEVDEV_READ_STATUS_SYNC) mode = LIBEVDEV_READ_FLAG_SYNC;
      if (event.type == EV_KEY) switches_.takeKey(event.code, event.value != 0);
      if (event.type == EV_ABS) switches_.takeAxis(event.code, event.value);
    }
  }

 private:
  Reading(int fd, libevdev* device, const FoundPedal& pedal, const std::vector<PedalSwitch>& chosen)
      : fd_(fd), device_(device) {
    const std::vector<PedalSwitch> switches = switchesOn(device, chosen.empty() ? usualSwitches(pedal) : chosen);
    has_switches_ = !switches.empty();
    switches_ = PedalSwitches(switches);
    if (pedal.sendsLetters()) libevdev_grab(device, LIBEVDEV_GRAB);
    for (const PedalSwitch& one : switches)
      if (!one.is_axis && libevdev_get_event_value(device, EV_KEY, one.code) != 0) switches_.beginDown(one.code);
  }

  int fd_;
  struct Freed {
    void operator()(libevdev* device) const { libevdev_free(device); }
  };

  std::unique_ptr<libevdev, Freed> device_;
  PedalSwitches switches_;
  bool has_switches_ = false;
};

FootPedal::FootPedal(const PedalChoice& choice, InputFolders folders) : choice_(choice), folders_(std::move(folders)) {
  for (const PedalBinding& binding : choice_.mapping) chosen_.push_back(switchOf(binding));
  wake_fd_ = eventfd(0, EFD_CLOEXEC);
  if (wake_fd_ < 0)
    throw DeviceError("pedal: the system has no file handles left, close other programs", DeviceTrouble::no_resources);
  described_.reserve(kOutOfMemory.size());
  describe("no pedal found yet");
  thread_ = std::thread([this] { run(); });
}

FootPedal::~FootPedal() {
  eventfd_write(wake_fd_, 1);
  thread_.join();
  close(wake_fd_);
}

std::string FootPedal::described() const {
  const std::lock_guard lock(mutex_);
  return described_;
}

void FootPedal::describe(std::string text) {
  const std::lock_guard lock(mutex_);
  described_.assign(text);
}

void FootPedal::publish(HandActions held) {
  count_.look(held);
  for (std::size_t i = 0; i < kHandActions; ++i)
    presses_[i].store(count_.of(static_cast<HandAction>(i)), std::memory_order_relaxed);
  held_.store(held.bits, std::memory_order_relaxed);
}

/// No exception leaves the thread: a failure ends it with a description.
void FootPedal::run() try {
  std::unique_ptr<Reading> reading;
  for (;;) {
    if (!reading) {
      for (const FoundPedal& pedal : pedalsMeant(choice_.wanted, folders_)) {
        reading = Reading::of(pedal, chosen_);
        if (reading && !reading->hasSwitches()) reading.reset();
        const std::string name = pedal.traits.name + ", " + pedal.path.string();
        describe(reading             ? name
                 : pedal.may_be_read ? name + ": it has none of the switches that are mapped"
                                     : name + ": it may not be read, see molar doctor --udev-rules");
        if (reading) break;
      }
      there_.store(reading != nullptr);
    }
    std::array<pollfd, 2> waits{{{wake_fd_, POLLIN, 0}, {reading ? reading->fd() : -1, POLLIN, 0}}};
    if (poll(waits.data(), waits.size(), reading ? -1 : kSearchInterval_ms) < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category());
    if (waits[0].revents != 0) return;
    if (!reading || waits[1].revents == 0) continue;
    const bool gone = !reading->read() || (waits[1].revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
    publish(gone ? HandActions{} : reading->held());
    if (!gone) continue;
    reading.reset();
    describe("the pedal was unplugged");
  }
} catch (...) {
  publish({});
  there_.store(false);
  const std::lock_guard lock(mutex_);
  described_.assign(kOutOfMemory);
}

}  // namespace haptics
