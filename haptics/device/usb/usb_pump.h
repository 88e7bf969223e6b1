// The event thread of a transport: keeps IN transfers in flight, publishes what they bring, sends the newest report,
// cancels transfers past their deadline, clears halted endpoints, detects that the device is gone. Internal to the
// transport, whose thread rules hold; run() is the event thread itself.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>
#include <thread>

#include "haptics/device/usb/usb_link.h"
#include "haptics/device/usb/usb_outbox.h"
#include "haptics/device/usb/usb_transfer.h"
#include "haptics/device/usb/usb_transport.h"
#include "haptics/device/usb/wake_signal.h"
#include "haptics/latest.h"

namespace haptics {

class UsbPump {
 public:
  UsbPump(UsbLink& link, const UsbStream& stream);
  ~UsbPump();
  UsbPump(const UsbPump&) = delete;
  UsbPump& operator=(const UsbPump&) = delete;

  // The servo thread.
  const UsbReport& newestReport() noexcept;
  bool awaitReport(std::int64_t deadline_ns) noexcept;
  void send(const UsbReport& report, std::uint32_t rests) noexcept;

  // Any thread.
  std::uint32_t rests() const noexcept { return outbox_.rests(); }
  void rest() noexcept;
  bool sendLast(const UsbReport& report, std::chrono::milliseconds within) noexcept;
  UsbState state() const noexcept { return state_.load(); }
  UsbCounters counters() const noexcept;

  void stop() noexcept;

 private:
  struct Counted {
    std::atomic<std::uint64_t> reports_in{0}, reports_out{0}, in_timeouts{0}, out_timeouts{0}, stalls{0},
        short_reports{0}, overlong_reports{0}, errors{0};
  };
  /// One direction: halts and failures in a row, and when to try again.
  struct Health {
    bool halted = false;
    int clearings = 0, failures = 0;
    std::int64_t again_at_ns = 0;
  };

  void run() noexcept;
  void submitIn(std::int64_t now_ns) noexcept;
  void submitOut(std::int64_t now_ns) noexcept;
  void settleIn(std::int64_t now_ns) noexcept;
  void settleOut(std::int64_t now_ns) noexcept;
  void settleTrouble(UsbOutcome outcome, Health& health, std::int64_t now_ns) noexcept;
  void receive(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept;
  void clearHalt(const UsbPipe& pipe, Health& health) noexcept;
  void updateState(std::int64_t now_ns) noexcept;
  std::int64_t nextCheck_ns(std::int64_t now_ns) const noexcept;
  void cancelAll() noexcept;
  bool anyInFlight() const noexcept;

  UsbLink& link_;
  UsbStream stream_;
  WakeSignal wake_, received_signal_;
  Latest<UsbReport> received_;
  UsbOutbox outbox_;
  std::atomic<UsbState> state_{UsbState::late};
  std::atomic<bool> quit_{false};
  Counted counted_;

  // Of the servo thread.
  std::uint64_t serial_seen_ = 0;

  // Of the event thread.
  std::deque<UsbTransfer> ins_;
  UsbTransfer out_;
  Health in_health_, out_health_;
  bool gone_ = false, out_late_ = false;
  std::uint64_t serial_ = 0;
  std::int64_t received_at_ns_ = 0;
  std::thread thread_;
};

}  // namespace haptics
