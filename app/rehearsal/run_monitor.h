// Decides when a rehearsal is over and why, and which events have to be reported, each once. State and time are passed
// in. Main thread, once a frame; microseconds.
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

/// The kind of notices about withdrawn forces.
inline constexpr char kSafetyNotice[] = "safety";

enum class Ending { interrupted, by_user, procedure, time_over, silent };
/// "interrupted", "by the user", … as stored in a session.
const char* textOf(Ending ending);

struct StationHealth {
  haptics::TripCounter trips;
  std::string device_trouble;                    ///< empty: none
  std::optional<std::string> recording_trouble;  ///< from the moment it ended early
  std::vector<std::string> news;                 ///< units unplugged, second hand; each passed once
};

class RunMonitor {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `duration_s`: simulated time; none: until ended by request.
  explicit RunMonitor(std::optional<double> duration_s) : duration_s_(duration_s) {}

  void endByUser() { ended_by_user_ = true; }
  /// Whether this tick is the last of its time.
  bool isTimeOver(const haptics::Tick& newest) const;
  /// None while it goes on. `awaits_tick`: the newest command is not in force yet; the time is over only after that.
  /// 10 s without a tick end the rehearsal.
  std::optional<Ending> ending(const haptics::Tick& newest, Time now, bool interrupted, bool procedure_is_over,
                               bool awaits_tick = false);

  /// News to report. `hands_off`: the command asks for no force.
  std::vector<Notice> takeNotices(const StationHealth& health, const haptics::Tick& newest, bool hands_off = false);

  /// Early.
  bool recordingEnded() const { return recording_ended_; }
  void describe(RehearsalStatus& status) const;

 private:
  std::optional<double> duration_s_;
  std::optional<Time> ticked_at_;
  std::uint64_t index_seen_ = 0;
  std::string device_trouble_;
  TripReporter trip_reporter_;
  haptics::TripCounter trips_;
  bool ended_by_user_ = false, recording_ended_ = false;
};

}  // namespace app
