// One USB device over libusb: a pipe of reports in and one out, interrupt or bulk as its descriptors say. Before run():
// requests with a timeout, on the constructing thread. From run() on an event thread keeps several IN transfers in
// flight, publishes the newest report and sends the newest one it was given, each transfer with a deadline; nothing
// throws any more, trouble is a UsbState and a counter. newestReport(), awaitReport(), send(): one servo thread, no
// lock, no allocation, one system call. rest(), sendLast(), state(), counters(): any thread. No device's protocol.
// Linux (usbfs); clearing a halt can block the event thread for long.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "haptics/device/thread_priority.h"
#include "haptics/device/usb/usb_clock.h"
#include "haptics/device/usb/usb_report.h"

namespace haptics {

class UsbLink;
class UsbPump;
class UsbTransfer;

struct UsbAddress {
  std::uint16_t vendor = 0, product = 0;
  std::string path = {};  ///< bus and ports as the kernel writes them, "1-2.3"; empty: the first that is found
  int interface = 0;
  std::string called = {};  ///< name of the device in messages
};

/// A control request; `type` is bmRequestType, bit 7: data comes in.
struct UsbSetup {
  std::uint8_t type = 0, request = 0;
  std::uint16_t value = 0, index = 0;
};

/// Extracts a report from the bytes of a transfer; empty: none yet. Event thread; must not throw.
using UsbReader = std::function<std::optional<UsbReport>(std::span<const std::uint8_t> bytes)>;

struct UsbStream {
  std::size_t report_bytes = 0;             ///< of one report in; shorter or longer ones are counted and dropped
  UsbReader reader;                         ///< instead of `report_bytes`, if a report is not one transfer
  UsbReport rest;                           ///< the rest report: zero force
  std::chrono::milliseconds rest_after{0};  ///< without a report it is sent by itself; 0: never. Older reports are void
  int in_flight = 3;                        ///< IN transfers at a time
  std::chrono::milliseconds late_after{20};     ///< without a received report the state is `late`
  std::chrono::milliseconds in_deadline{100};   ///< an IN transfer without data is cancelled and submitted again
  std::chrono::milliseconds out_deadline{20};   ///< an OUT transfer not accepted is cancelled and dropped
  std::chrono::milliseconds dead_after{2'000};  ///< a cancelled transfer that does not complete: the state is `gone`
  int max_clearings = 3;                        ///< of a halted endpoint in a row, then it stays `stalled`
  int priority = usbPriority(kServoPriority);   ///< SCHED_FIFO priority of the event thread, best effort
};

class UsbTransport {
 public:
  /// Opens and claims; detaches a kernel driver if it can. Throws DeviceError when the device is not there, not
  /// permitted, in use, or has no pair of IN and OUT pipes.
  explicit UsbTransport(const UsbAddress& address, UsbClock clock = {});
  /// As stop().
  ~UsbTransport();
  UsbTransport(const UsbTransport&) = delete;
  UsbTransport& operator=(const UsbTransport&) = delete;

  std::size_t inPacketBytes() const;
  std::size_t outPacketBytes() const;
  const std::string& path() const;
  UsbClock clock() const;
  /// Empty: none, or not readable.
  const std::string& serialNumber() const;

  // Before run().
  UsbExchange control(const UsbSetup& setup, std::span<std::uint8_t> data, std::chrono::milliseconds within);
  UsbExchange write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds within);
  /// One packet, of up to inPacketBytes(); what does not fit is lost.
  UsbExchange read(std::span<std::uint8_t> bytes, std::chrono::milliseconds within);

  /// The stream begins. Once. Throws DeviceError when there is no memory for its transfers.
  void run(const UsbStream& stream);

  // The servo thread.
  /// Serial 0: none yet.
  const UsbReport& newestReport() noexcept;
  /// Waits for a report that newestReport() has not returned yet; false: the deadline (CLOCK_MONOTONIC) was first.
  bool awaitReport(std::int64_t deadline_ns) noexcept;
  /// The newest wins. `rests`: rests() from when the report began to be made; a rest since then voids it.
  void send(const UsbReport& report, std::uint32_t rests) noexcept;

  // Any thread.
  std::uint32_t rests() const noexcept;
  /// Sends the rest report at once; no report made before is sent any more.
  void rest() noexcept;
  /// Sends this report, then nothing any more. True: the device accepted it before the deadline; nothing follows in
  /// either case. Only the first call counts. Also from a signal handler.
  bool sendLast(const UsbReport& report, std::chrono::milliseconds within) noexcept;
  UsbState state() const noexcept;
  UsbCounters counters() const noexcept;

  /// Ends all transfers and joins the event thread. One thread. sendLast() before it.
  void stop() noexcept;

 private:
  /// Submits, pumps, cancels at the deadline.
  UsbExchange exchange(UsbTransfer& transfer, std::size_t size, std::chrono::milliseconds within);

  std::unique_ptr<UsbLink> link_;
  std::unique_ptr<UsbPump> pump_;
  std::atomic<UsbPump*> running_{nullptr};  ///< null before run()
  bool is_dead_ = false;
};

}  // namespace haptics
