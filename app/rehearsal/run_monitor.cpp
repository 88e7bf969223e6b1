#include "app/rehearsal/run_monitor.h"

#include <utility>

namespace app {
namespace {

constexpr std::chrono::seconds kLongestSilence{10};
constexpr double kRounding_s = 1e-7;  ///< of the sum of the ticks' dt

}  // namespace

const char* textOf(Ending ending) {
  constexpr const char* kTexts[] = {"interrupted", "by the user", "the procedure is over", "time over",
                                    "the device fell silent"};
  return kTexts[static_cast<int>(ending)];
}

bool RunMonitor::isTimeOver(const haptics::Tick& newest) const {
  return duration_s_ && newest.t_s + newest.dt_s >= *duration_s_ - kRounding_s;
}

std::optional<Ending> RunMonitor::ending(const haptics::Tick& newest, Time now, bool interrupted,
                                         bool procedure_is_over, bool awaits_tick) {
  if (newest.index != index_seen_ || !ticked_at_) ticked_at_ = now;
  index_seen_ = newest.index;
  if (interrupted) return Ending::interrupted;
  if (ended_by_user_) return Ending::by_user;
  if (procedure_is_over) return Ending::procedure;
  if (isTimeOver(newest) && !awaits_tick) return Ending::time_over;
  return now - *ticked_at_ >= kLongestSilence ? std::optional(Ending::silent) : std::nullopt;
}

std::vector<Notice> RunMonitor::takeNotices(const StationHealth& health, const haptics::Tick& newest, bool hands_off) {
  std::vector<Notice> notices;
  for (const std::string& line : health.news) notices.push_back({"device", line});
  if (health.recording_trouble && !std::exchange(recording_ended_, true))
    notices.push_back({"recording", "not recording, the rehearsal goes on: " + *health.recording_trouble});
  if (std::exchange(device_trouble_, health.device_trouble) != health.device_trouble && !health.device_trouble.empty())
    notices.push_back({"device", health.device_trouble});
  if (newest.dt_s <= 0.0) return notices;  // not a tick yet
  trips_ = health.trips;
  // That there is no force while the ring is open is no news.
  const bool as_asked = hands_off && newest.state == haptics::SafetyState::ready;
  const haptics::SafetyState state = as_asked ? haptics::SafetyState::active : newest.state;
  for (const std::string& line : trip_reporter_.update(trips_, state)) notices.push_back({kSafetyNotice, line});
  return notices;
}

void RunMonitor::describe(RehearsalStatus& status) const {
  status.trips = trips_;
  if (status.recording != RecordingState::none && recording_ended_) status.recording = RecordingState::ended_early;
}

}  // namespace app
