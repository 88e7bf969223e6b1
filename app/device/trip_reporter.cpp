#include "app/device/trip_reporter.h"

#include <fmt/core.h>

namespace app {
namespace {

/// The force was limited, not withdrawn.
bool onlyLimits(haptics::Fault fault) { return fault == haptics::Fault::clamped || fault == haptics::Fault::slewed; }

}  // namespace

std::vector<std::string> TripReporter::update(const haptics::TripCounter& trips, haptics::SafetyState state) {
  std::vector<std::string> lines;
  for (const haptics::TripText& trip : haptics::kTrips) {
    const auto &now = trips.of(trip.fault), &before = seen_.of(trip.fault);
    if (now.times == before.times || onlyLimits(trip.fault)) continue;
    if (trip.fault == haptics::Fault::resumed && before.times > 0) {
      paused_again_ = true;
      continue;
    }
    std::string line = fmt::format("{} {} (tick {}", trip.what, trip.next, now.last_tick);
    if (now.times > 1) line += fmt::format(", {} times", now.times);
    lines.push_back(line + ")");
  }
  const bool said_before =
      paused_again_ && (state == haptics::SafetyState::ready || state == haptics::SafetyState::armed ||
                        state == haptics::SafetyState::active);
  if (state == haptics::SafetyState::active) paused_again_ = false;
  if (state != state_ && !said_before) {
    const haptics::StateText& words = haptics::textOf(state);
    lines.push_back(std::string(words.what) + " " + std::string(words.next));
  }
  seen_ = trips;
  state_ = state;
  return lines;
}

std::string tripsText(const haptics::TripCounter& trips) {
  std::string text;
  for (const haptics::TripText& trip : haptics::kTrips)
    if (const auto& entry = trips.of(trip.fault); entry.times > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", trip.key, entry.times);
  return text.empty() ? "none" : text;
}

}  // namespace app
