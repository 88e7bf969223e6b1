// Watches a rehearsal while it runs: whether it is over and why, and what has to be told, each once. Every time it is
// told what is so and what time it is; it asks nobody, so a test plays years in milliseconds. Main thread, once a
// frame; microseconds.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/device/trip_reporter.h"
#include "app/instructor/rehearsal_status.h"
#include "app/rehearsal/event_log.h"
#include "haptics/safety/trips.h"
#include "haptics/servo/tick.h"

namespace app {

enum class Ending { interrupted, by_user, procedure, time_over, silent };
/// "interrupted", "by the user", … as a session keeps it.
const char* textOf(Ending ending);

/// What the station says of itself.
struct StationHealth {
  haptics::TripCounter trips;
  std::string device_trouble;                    ///< while there is any
  std::optional<std::string> recording_trouble;  ///< from the moment it ended early
  std::vector<std::string> news;                 ///< of units unplugged and the other hand: each given once
};

class RunMonitor {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `duration_s`: simulated time; none: until somebody ends it.
  explicit RunMonitor(std::optional<double> duration_s) : duration_s_(duration_s) {}

  void endByUser() { ended_by_user_ = true; }
  /// Whether this tick is the last of its time.
  bool isTimeOver(const haptics::Tick& newest) const;
  /// None while it goes on. `awaits_tick`: something asked for is not in force yet, the time is over only once it was.
  /// A device that does not tick any more ends nothing by itself, so 10 s of silence do.
  std::optional<Ending> ending(const haptics::Tick& newest, Time now, bool interrupted, bool procedure_is_over,
                               bool awaits_tick = false);

  /// What is new of it and has to be told.
  std::vector<Notice> look(const StationHealth& health, const haptics::Tick& newest);

  /// What of it the instructor sees.
  void describe(RehearsalStatus& status) const;

 private:
  std::optional<double> duration_s_;
  std::optional<Time> ticked_at_;
  std::uint64_t index_seen_ = 0;
  std::string device_trouble_;
  TripReporter trip_teller_;
  haptics::TripCounter trips_;
  bool ended_by_user_ = false, recording_ended_ = false;
};

}  // namespace app
