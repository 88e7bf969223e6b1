// What goes over a USB endpoint, and how the line fares: plain data, trivially copyable, any thread.
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
  std::uint64_t serial = 0;      ///< of reports that came in, from 1; 0: none came yet
  std::int64_t received_ns = 0;  ///< CLOCK_MONOTONIC

  UsbReport() = default;
  explicit UsbReport(std::span<const std::uint8_t> content)
      : size(static_cast<std::uint16_t>(std::min(content.size(), kMaxBytes))) {
    std::copy_n(content.begin(), size, bytes.begin());
  }
  std::span<const std::uint8_t> content() const { return {bytes.data(), size}; }
};

/// How the line is now. `gone` is for good; so is `stalled` once clearing it was of no use.
enum class UsbState : std::uint8_t { ok, late, stalled, gone };

/// Since the stream began.
struct UsbCounters {
  std::uint64_t reports_in = 0, reports_out = 0;
  std::uint64_t replaced_out = 0;  ///< reports a newer one came before
  std::uint64_t silences = 0;      ///< rests that went out because nobody sent anything
  std::uint64_t in_timeouts = 0, out_timeouts = 0;
  std::uint64_t stalls = 0;  ///< endpoints found halted
  std::uint64_t short_reports = 0, overlong_reports = 0;
  std::uint64_t errors = 0;  ///< transfers the bus or the kernel failed
};

/// How one request went before the stream began.
enum class UsbOutcome : std::uint8_t { done, late, stalled, gone, failed };

struct UsbExchange {
  UsbOutcome outcome = UsbOutcome::failed;
  std::size_t bytes = 0;
  bool done() const { return outcome == UsbOutcome::done; }
};

}  // namespace haptics
