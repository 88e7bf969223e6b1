// Reports each trip of the safety layer once, in words, with its last tick, for the user and the record. Faults that
// only limit a force are counted, not reported; a pause of the loop is reported the first time, then counted. Main
// thread, a few times a second.
#pragma once

#include <string>
#include <vector>

#include "haptics/safety/safety_state.h"
#include "haptics/safety/trips.h"

namespace app {

class TripReporter {
 public:
  /// A line for every trip since the last call, and for a changed state.
  std::vector<std::string> update(const haptics::TripCounter& trips, haptics::SafetyState state);

 private:
  haptics::TripCounter seen_;
  haptics::SafetyState state_ = haptics::SafetyState::active;
  bool paused_again_ = false;  ///< what follows until the force is back was said after the first pause
};

/// "buzz 2, stale 1": all kinds that occurred, limits included; "none" if none did.
std::string tripsText(const haptics::TripCounter& trips);

}  // namespace app
