// The process beside a rehearsal, `molar seat`: follows its servo by what it was given (session/input_feed) and says
// what the bone is like in each tick (seat_words). Low priority, never on the servo's core; ends when the rehearsal
// does. Every kBetweenStates_s of the session a whole state is kept, to go on from after a death: as a process
// (seat_keeper), and as memory, for one that is started when all of these are gone (seat_arena). Holds
// no file of the rehearsal but those that it was given. Linux.
#pragma once

#include <string>
#include <vector>

namespace app {

struct SeatOptions {
  int recording = -1, feed = -1, words = -1;  ///< descriptors
  int states = -1;                            ///< shared memory for seat_arena; -1: none
  std::vector<std::string> ids;
};

inline constexpr double kBetweenStates_s = 10.0;

/// The exit status. Throws SessionError: what it is fed with cannot be read.
int runSeat(const SeatOptions& options);

}  // namespace app
