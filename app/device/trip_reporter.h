// Says what the safety layer did, once each time it did it: in words, with the last tick that had it, for the person
// and the record. What only holds a force within its limits is counted, not said. Main thread, a few times a second.
#pragma once

#include <string>
#include <vector>

#include "haptics/safety/safety_state.h"
#include "haptics/safety/trips.h"

namespace app {

class TripReporter {
 public:
  /// A line for every trip since the last look, and for a state that is another.
  std::vector<std::string> look(const haptics::TripCounter& trips, haptics::SafetyState state);

 private:
  haptics::TripCounter seen_;
  haptics::SafetyState state_ = haptics::SafetyState::active;
};

/// "buzz 2, stale 1": all kinds that occurred, limits too; "none" where none did.
std::string tripsText(const haptics::TripCounter& trips);

}  // namespace app
