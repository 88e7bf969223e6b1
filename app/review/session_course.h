// The course of a recorded session over time, for its timeline and charts: force and bone removed in bins of half a
// second, when the drill worked, what was in the hand, what happened. s, N, mm3. A pass over the ticks; any thread.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/review/session_marks.h"
#include "app/session/session_reader.h"

namespace app {

struct TimeSpan {
  double from_s = 0.0, to_s = 0.0;
  std::string what{};
};

struct SessionCourse {
  static constexpr double kBin_s = 0.5;
  static constexpr double kForceBin_N = 0.25;
  static constexpr std::size_t kForceBins = 24;  ///< the last one takes all above, too

  std::vector<double> most_force_N, removed_mm3;  ///< by bin
  std::vector<TimeSpan> drilling, tools;          ///< in bone, pauses below half a second bridged; in the hand
  std::vector<SessionMark> marks;                 ///< in order of time, without steps and instruments
  std::array<double, kForceBins> force_s{};       ///< time drilling in bone by the force of the model
  double duration_s = 0.0;
};

/// Rewinds the session, which must be undamaged.
SessionCourse courseOf(SessionReader& session);

}  // namespace app
