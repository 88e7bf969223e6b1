// A report on a USB endpoint, the state of the line and its counters: plain data, trivially copyable, any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace haptics {

/// One report, or the first bytes of a longer one.
struct UsbReport {
  static constexpr std::size_t kMaxBytes = 64;

  std::array<std::uint8_t, kMaxBytes> bytes{};
  std::uint16_t size = 0;
  std::uint64_t serial = 0;      ///< of received reports, from 1; 0: none yet
  std::int64_t received_ns = 0;  ///< CLOCK_MONOTONIC

  UsbReport() = default;
  explicit UsbReport(std::span<const std::uint8_t> content)
      : size(static_cast<std::uint16_t>(std::min(content.size(), kMaxBytes))) {
    std::copy_n(content.begin(), size, bytes.begin());
  }
  std::span<const std::uint8_t> content() const { return {bytes.data(), size}; }
};

/// State of the line. `gone` is final; so is `stalled` once clearing has failed.
enum class UsbState : std::uint8_t { ok, late, stalled, gone };

/// Since the stream began.
struct UsbCounters {
  std::uint64_t reports_in = 0, reports_out = 0;
  std::uint64_t replaced_out = 0;  ///< replaced by a newer one before they were sent
  std::uint64_t silences = 0;      ///< rests sent for lack of reports
  std::uint64_t in_timeouts = 0, out_timeouts = 0;
  std::uint64_t stalls = 0;  ///< endpoints found halted
  std::uint64_t short_reports = 0, overlong_reports = 0;
  std::uint64_t errors = 0;  ///< failed transfers
};

/// Result of one request before the stream.
enum class UsbOutcome : std::uint8_t { done, late, stalled, gone, failed };

struct UsbExchange {
  UsbOutcome outcome = UsbOutcome::failed;
  std::size_t bytes = 0;
  bool done() const { return outcome == UsbOutcome::done; }
};

}  // namespace haptics
