// One USB device over libusb: a pipe of reports in, a pipe of reports out, interrupt or bulk as its descriptors say.
// Before run(): requests with a deadline, the constructing thread alone. From run() on: an event thread of its own
// keeps several IN transfers in flight, hands over the newest report and sends the newest one it was given, each
// transfer with a deadline; nothing throws any more, trouble is a UsbState and a counter. newestReport(),
// awaitReport(), send(): one servo thread, no lock, no allocation, one system call. rest(), sendLast(), state(),
// counters(): any thread. Knows no device's protocol. Linux (usbfs); mind that a clear-halt there can hold the event
// thread up for long.
#pragma once

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

struct UsbAddress {
  std::uint16_t vendor = 0, product = 0;
  std::string path = {};  ///< bus and ports as the kernel writes them, "1-2.3"; empty: the first that is found
  int interface = 0;
  std::string called = {};  ///< as people call the device, before what can not be
};

/// A control request; `type` is bmRequestType, whose bit 7 says that data comes in.
struct UsbSetup {
  std::uint8_t type = 0, request = 0;
  std::uint16_t value = 0, index = 0;
};

/// What the device said in one transfer, as a report of its protocol. Empty: nothing yet. Event thread; must not throw.
using UsbReader = std::function<std::optional<UsbReport>(std::span<const std::uint8_t> bytes)>;

struct UsbStream {
  std::size_t report_bytes = 0;  ///< of one report in; anything shorter or longer is counted and dropped
  UsbReader reader;              ///< instead of `report_bytes`, where a report is not one transfer
  UsbReport rest;                ///< the report that lets the motors go
  std::chrono::milliseconds rest_after{
      0};             ///< of silence, then it goes out by itself; 0: never. Older reports are void
  int in_flight = 3;  ///< IN transfers at a time
  std::chrono::milliseconds late_after{20};     ///< without a report in, the state is `late`
  std::chrono::milliseconds in_deadline{100};   ///< an IN transfer that heard nothing is taken back and sent again
  std::chrono::milliseconds out_deadline{20};   ///< an OUT transfer nobody took is taken back and dropped
  std::chrono::milliseconds dead_after{2'000};  ///< a transfer that can not be taken back: the handle is dead, `gone`
  int max_clearings = 3;                        ///< of a halted endpoint in a row, then it stays `stalled`
  int priority = usbPriority(kServoPriority);   ///< SCHED_FIFO's that the event thread asks for
};

class UsbTransport {
 public:
  /// Opens and claims; takes the interface from a kernel driver where it can. Throws DeviceError when the device is not
  /// there, not permitted, in use, or has no pair of IN and OUT pipes.
  explicit UsbTransport(const UsbAddress& address, UsbClock clock = {});
  /// As stop().
  ~UsbTransport();
  UsbTransport(const UsbTransport&) = delete;
  UsbTransport& operator=(const UsbTransport&) = delete;

  std::size_t inPacketBytes() const;
  std::size_t outPacketBytes() const;
  const std::string& path() const;
  UsbClock clock() const;
  /// As the device gives it; empty where it has none or can not be read.
  const std::string& serialNumber() const;

  // Before run().
  UsbExchange control(const UsbSetup& setup, std::span<std::uint8_t> data, std::chrono::milliseconds within);
  UsbExchange write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds within);
  /// One packet: give room for inPacketBytes(), what does not fit is lost.
  UsbExchange read(std::span<std::uint8_t> bytes, std::chrono::milliseconds within);

  /// The stream begins. Once. Throws DeviceError when there is no memory for its transfers.
  void run(const UsbStream& stream);

  // The servo thread.
  /// Serial 0 until one came.
  const UsbReport& newestReport() noexcept;
  /// Until there is a report that newestReport() has not shown yet; false: the deadline (CLOCK_MONOTONIC) was first.
  bool awaitReport(std::int64_t deadline_ns) noexcept;
  /// The newest wins. `rests` as rests() was when the report began to be made: with a rest since, it is void.
  void send(const UsbReport& report, std::uint32_t rests) noexcept;

  // Any thread.
  std::uint32_t rests() const noexcept;
  /// The rest report at once; no report made before goes out any more.
  void rest() noexcept;
  /// This one, then nothing ever again. True when the device has taken it before the deadline; when not, nothing
  /// follows all the same. Called twice, the first is what is sent. Also from a signal handler.
  bool sendLast(const UsbReport& report, std::chrono::milliseconds within) noexcept;
  UsbState state() const noexcept;
  UsbCounters counters() const noexcept;

  /// No more transfers; joins the event thread. One thread. Send what shall be last before.
  void stop() noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace haptics
