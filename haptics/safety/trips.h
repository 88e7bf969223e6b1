// Texts of all trips of the safety layer, and a counter of trips. The counter takes the faults tick by tick on one
// thread that is not the servo's (a drained TickLog, a session read again); fixed memory. A trip begins with a tick
// whose predecessor lacks the fault.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "haptics/safety/fault.h"
#include "haptics/safety/safety_state.h"

namespace haptics {

struct TripText {
  Fault fault;
  std::string_view key;   ///< for files
  std::string_view what;  ///< one sentence
  std::string_view next;  ///< what to do
};

/// In the order of their bits.
inline constexpr std::size_t kTripKinds = 16;
extern const std::array<TripText, kTripKinds> kTrips;

struct StateText {
  std::string_view key, what, next;
};
const StateText& textOf(SafetyState state);

class TripCounter {
 public:
  struct Entry {
    std::uint64_t times = 0;
    std::uint64_t first_tick = 0, last_tick = 0;  ///< of the ticks with it; 0 without any
  };

  void add(std::uint64_t tick, Fault faults) noexcept;

  /// Of one fault; of several the lowest bit.
  const Entry& of(Fault one) const noexcept;

 private:
  std::array<Entry, kTripKinds> entries_{};
  Fault last_ = Fault::none;
};

}  // namespace haptics
