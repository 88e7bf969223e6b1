// One asynchronous transfer, reused, with a deadline of our own: libusb's timers are not used, because a dead handle
// can starve them. Internal to the transport; the thread that pumps its link.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "haptics/device/usb/usb_report.h"

struct libusb_transfer;

namespace haptics {

class UsbLink;
struct UsbPipe;

class UsbTransfer {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  /// Throws DeviceError when out of memory.
  UsbTransfer(UsbLink& link, const UsbPipe& pipe, std::size_t capacity);
  ~UsbTransfer();
  UsbTransfer(const UsbTransfer&) = delete;
  UsbTransfer& operator=(const UsbTransfer&) = delete;

  std::span<std::uint8_t> buffer() { return buffer_; }

  /// Sends or receives `size` bytes of the buffer. False: refused, and finished with that outcome.
  bool submit(std::size_t size, std::int64_t deadline_ns) noexcept;
  void cancel() noexcept;
  /// Cancels when the deadline is past.
  void expire(std::int64_t now_ns) noexcept;

  bool inFlight() const { return in_flight_; }
  /// In flight: when to call expire().
  std::int64_t deadline_ns() const { return cancelled_at_ns_ == kNever ? deadline_ns_ : kNever; }
  /// In flight: cancelled, and not completed for so long.
  bool isDead(std::int64_t now_ns, std::int64_t after_ns) const {
    return in_flight_ && cancelled_at_ns_ != kNever && now_ns - cancelled_at_ns_ > after_ns;
  }
  /// True once after each submit, when it has completed.
  bool takeFinished() noexcept { return std::exchange(finished_, false); }
  UsbOutcome outcome() const { return outcome_; }
  bool overflowed() const { return overflowed_; }
  /// Order of completion among its link's transfers.
  std::uint64_t order() const { return order_; }
  bool finished() const { return finished_; }
  /// Bytes of the last completed transfer.
  std::span<const std::uint8_t> moved() const { return {buffer_.data(), moved_}; }

  void onDone() noexcept;  ///< called back by libusb

 private:
  UsbLink& link_;
  libusb_transfer* transfer_;
  std::vector<std::uint8_t> buffer_;
  bool in_flight_ = false, finished_ = false, overflowed_ = false;
  UsbOutcome outcome_ = UsbOutcome::failed;
  std::size_t moved_ = 0;
  std::uint64_t order_ = 0;
  std::int64_t deadline_ns_ = kNever, cancelled_at_ns_ = kNever;
};

}  // namespace haptics
