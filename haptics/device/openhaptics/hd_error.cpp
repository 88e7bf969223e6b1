#include "haptics/device/openhaptics/hd_error.h"

#include <algorithm>
#include <cstdio>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

constexpr auto kPassing = HdErrorKind::passing;
constexpr auto kFatal = HdErrorKind::fatal;
constexpr const char* kReport = "report it with the model and the driver's version";

// Numbers: reference/devices 2. After an exceeded limit the amplifiers switch off and ramp back by themselves.
constexpr std::array<HdErrorMeaning, 21> kMeanings{{
    {0x0100, kPassing, "the library does not have a property that Molar requested", kReport},
    {0x0101, kPassing, "the library refused a value that Molar set", kReport},
    {0x0102, kPassing, "the library does not allow Molar's call at this moment", kReport},
    {0x0103, kPassing, "a property has another type than Molar requested", kReport},
    {0x0104, kFatal, "the library does not know the device any more", "plug it in and start again",
     DeviceTrouble::not_there},
    {0x0200, kPassing, "the motors are too warm", "rest the arm for some minutes and press less"},
    {0x0201, kPassing, "the force was larger than the device can give", "lower the stiffness or the peak force"},
    {0x0202, kPassing, "the force changed too fast", "lower the stiffness or the slew limit"},
    {0x0203, kPassing, "the stylus moved too fast", "move more slowly"},
    {0x0204, kFatal, "the device cannot give the requested force",
     "switch it off for ten seconds, then start again; if it stays, have it serviced"},
    {0x0300, kFatal, "the device reports a fault", "switch it off for ten seconds, check its cables, start again"},
    {0x0301, kFatal, "the device is in use already", "end the other program that uses it, then start again",
     DeviceTrouble::busy},
    {0x0302, kFatal, "the connection to the device broke", "check its cable and power, plug it in and start again",
     DeviceTrouble::not_there},
    {0x0303, kFatal,
     "the device refuses the connection, as one does that a program left without closing it, or whose serial port "
     "another program holds",
     "unplug it for ten seconds and plug it in again; stop ModemManager if it runs; run Touch_Setup once so that the "
     "port in its configuration is right",
     DeviceTrouble::busy},
    {0x0304, kFatal, "the library's timer failed", "start again; if it stays, restart the computer"},
    {0x0400, kPassing, "a frame was begun inside another", kReport},
    {0x0401, kPassing, "a frame was ended that had not begun", kReport},
    {0x0402, kPassing, "a frame was not kept in order", kReport},
    {0x0500, kFatal, "the scheduler refused the servo's priority", kReport},
    {0x0501, kFatal, "the scheduler is full", "end other work that uses OpenHaptics in this program"},
    {0x0600, kFatal, "OpenHaptics has no valid licence",
     "install the licence that came with it, or OpenHaptics 3.5 Developer Edition, which needs none",
     DeviceTrouble::no_driver},
}};

constexpr HdErrorMeaning kUnknown{0xFFFFFFFF, kFatal, "the library reports an error that Molar does not know", kReport};

/// Index of its meaning; one past the last for an unknown code.
std::size_t indexOf(std::uint32_t code) {
  const auto found = std::ranges::find(kMeanings, code, &HdErrorMeaning::code);
  return static_cast<std::size_t>(found - kMeanings.begin());
}

}  // namespace

std::span<const HdErrorMeaning> hdErrorMeanings() { return kMeanings; }

const HdErrorMeaning& meaningOf(std::uint32_t code) {
  const std::size_t index = indexOf(code);
  return index < kMeanings.size() ? kMeanings[index] : kUnknown;
}

std::string errorText(const hd::ErrorInfo& error) {
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, "HD 0x%04X (internal %d)", error.code, error.internal_code);
  const HdErrorMeaning& meaning = meaningOf(error.code);
  return std::string(numbers) + ": " + meaning.what + "; " + meaning.what_to_do;
}

HdDrained HdErrors::drain(const HdFunctions& hd) noexcept {
  static_assert(kMeanings.size() < kMaxCodes);
  HdDrained drained;
  while (drained.count < kMaxPerDrain) {
    const hd::ErrorInfo error = hd.get_error();
    if (error.code == hd::kSuccess) break;
    const bool fatal = meaningOf(error.code).kind == HdErrorKind::fatal;
    if (drained.count == 0 || (fatal && !drained.fatal)) drained.first = error;
    ++drained.count;
    drained.fatal = drained.fatal || fatal;
    drained.warm_motors = drained.warm_motors || error.code == hd::kWarmMotors;
    counts_[indexOf(error.code)].fetch_add(1, std::memory_order_relaxed);
  }
  if (drained.fatal) {
    const auto internal = static_cast<std::uint32_t>(drained.first.internal_code);
    std::uint64_t none = 0;
    first_fatal_.compare_exchange_strong(none, std::uint64_t{drained.first.code} << 32 | internal);
  }
  return drained;
}

std::uint32_t HdErrors::count(std::uint32_t code) const {
  return counts_[indexOf(code)].load(std::memory_order_relaxed);
}

hd::ErrorInfo HdErrors::firstFatal() const {
  const std::uint64_t packed = first_fatal_.load();
  return {static_cast<std::uint32_t>(packed >> 32), static_cast<std::int32_t>(packed & 0xFFFFFFFF), 0};
}

void throwOnHdError(const HdFunctions& hd, const std::string& what) {
  HdErrors errors;
  const HdDrained drained = errors.drain(hd);
  if (drained.count > 0)
    throw DeviceError(what + ", " + errorText(drained.first), meaningOf(drained.first.code).trouble);
}

}  // namespace haptics
