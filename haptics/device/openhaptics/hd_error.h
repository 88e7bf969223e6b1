// The vendor's error codes: meaning, next step, kind; and the drain that empties the library's error stack once a frame
// (reference/devices 2, Errors). drain(): the thread that owns the device, at most kMaxPerDrain library calls, no
// allocation, no lock; the others: any thread. It counts errors and keeps the first fatal one.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>

#include "haptics/device/device_error.h"
#include "haptics/device/openhaptics/hd_library.h"

namespace haptics {

enum class HdErrorKind : std::uint8_t {
  passing,  ///< the library recovers; the force of this frame may be lost
  fatal     ///< no force from now on
};

struct HdErrorMeaning {
  std::uint32_t code;
  HdErrorKind kind;
  const char* what;
  const char* what_to_do;
  DeviceTrouble trouble = DeviceTrouble::faulty;
};

/// All codes that are known.
std::span<const HdErrorMeaning> hdErrorMeanings();
/// An unknown code counts as fatal.
const HdErrorMeaning& meaningOf(std::uint32_t code);
/// "HD 0x0302 (internal 17): the connection to the device broke; …"
std::string errorText(const hd::ErrorInfo& error);

/// Result of one drain.
struct HdDrained {
  int count = 0;
  bool fatal = false, warm_motors = false;
  hd::ErrorInfo first{};  ///< the newest, a fatal one if there is any
};

class HdErrors {
 public:
  static constexpr int kMaxPerDrain = 16;

  HdDrained drain(const HdFunctions& hd) noexcept;

  /// Errors of a code so far; unknown codes count together. Any thread.
  std::uint32_t count(std::uint32_t code) const;
  /// The first fatal one; code 0: none.
  hd::ErrorInfo firstFatal() const;

 private:
  static constexpr std::size_t kMaxCodes = 32;
  std::array<std::atomic<std::uint32_t>, kMaxCodes> counts_{};  ///< by index in hdErrorMeanings(), unknown ones last
  std::atomic<std::uint64_t> first_fatal_{0};                   ///< code and internal code, in one word
};

/// Throws DeviceError for the newest error on the stack, if there is one. Not for the scheduler's thread.
void throwOnHdError(const HdFunctions& hd, const std::string& what);

}  // namespace haptics
