#include "haptics/device/usb/wake_signal.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "haptics/device/haptic_device.h"
#include "haptics/device/monotonic_clock.h"

namespace haptics {

WakeSignal::WakeSignal() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0)
    throw DeviceError("USB: no file descriptor left for a signal, close other programs", DeviceTrouble::no_resources);
}

WakeSignal::~WakeSignal() { close(descriptor_); }

void WakeSignal::raise() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(descriptor_, &one, sizeof one);
}

void WakeSignal::lower() noexcept {
  std::uint64_t times = 0;
  [[maybe_unused]] const auto taken = read(descriptor_, &times, sizeof times);
}

bool WakeSignal::awaitUntil(std::int64_t deadline_ns) noexcept {
  for (;;) {
    const std::int64_t left_ns = deadline_ns - monotonic_ns();
    if (left_ns <= 0) return false;
    const timespec left = timespecOf(left_ns);
    pollfd raised{descriptor_, POLLIN, 0};
    if (ppoll(&raised, 1, &left, nullptr) > 0) {
      lower();
      return true;
    }
  }
}

}  // namespace haptics
