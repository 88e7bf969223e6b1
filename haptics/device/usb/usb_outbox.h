// Selects what goes out over the USB next: the newest report of the servo, the rest report (zero force), or the last
// report of all. Order: nothing after the last; the last before all others; a rest until it is sent; the newest, unless
// a rest or too long a wait voided it; a rest by itself after a silence. send(): the servo thread. rest(),
// requestLast(): any thread, also a signal handler. The others: the event thread. Lock-free, no allocation; times are
// parameters, ns of CLOCK_MONOTONIC.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "haptics/device/usb/usb_report.h"
#include "haptics/latest.h"

namespace haptics {

class UsbOutbox {
 public:
  /// `rest_after_ns` 0: never by itself.
  UsbOutbox(const UsbReport& rest, std::int64_t rest_after_ns) : rest_(rest), rest_after_ns_(rest_after_ns) {}

  void send(const UsbReport& report, std::uint32_t rests, std::int64_t now_ns) noexcept;

  std::uint32_t rests() const noexcept { return rests_.load(); }
  void rest() noexcept { rests_.fetch_add(1); }
  /// The first request wins. After the deadline it is given up, with one attempt made.
  void requestLast(const UsbReport& report, std::int64_t deadline_ns) noexcept;
  bool isOver() const noexcept { return phase_.load() == Phase::over; }
  bool lastWasTaken() const noexcept { return last_taken_.load(); }
  std::uint64_t replaced() const noexcept { return replaced_.load(std::memory_order_relaxed); }
  std::uint64_t silences() const noexcept { return silences_.load(std::memory_order_relaxed); }

  /// The report to submit now; taken() or notTaken() has to follow before the next call.
  std::optional<UsbReport> next(std::int64_t now_ns) noexcept;
  void taken() noexcept;
  void notTaken() noexcept;
  /// When to call next() again without a new report; `never_ns` if not.
  std::int64_t nextCheck_ns(std::int64_t never_ns) const noexcept;
  /// Nothing more goes out.
  void close() noexcept { end(false); }

 private:
  struct Outgoing {
    UsbReport report;
    std::uint32_t rests = 0;
    std::uint64_t number = 0;
    std::int64_t made_ns = 0;
  };
  enum class Phase : std::uint8_t { open, writing, last_wanted, over };

  std::optional<UsbReport> nextLast(std::int64_t now_ns) noexcept;
  void end(bool taken) noexcept;

  UsbReport rest_;
  std::int64_t rest_after_ns_;
  Latest<Outgoing> wanted_;
  std::atomic<std::uint32_t> rests_{0};
  std::atomic<Phase> phase_{Phase::open};
  std::atomic<bool> last_taken_{false};
  std::atomic<std::uint64_t> replaced_{0}, silences_{0};
  UsbReport last_;
  std::int64_t last_deadline_ns_ = 0;

  std::uint64_t sent_number_ = 0;  ///< of the servo thread

  // Of the event thread.
  bool resting_ = true;  ///< the device has zero force, or never had any
  bool last_under_way_ = false, last_tried_ = false;
  std::uint32_t rests_sent_ = 0, rests_under_way_ = 0;
  std::uint64_t number_taken_ = 0;
  std::int64_t made_at_ns_ = 0;
};

}  // namespace haptics
