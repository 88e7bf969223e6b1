#include "app/rehearsal/coach_follower.h"

#include <chrono>
#include <utility>

#include "app/session/coach_event.h"

namespace app {

CoachFollower::CoachFollower(CoachRules rules, const assets::Patient& patient, EventLog& event_log, bool waits)
    : coach_(std::move(rules)), event_log_(event_log) {
  coming_ = std::async(std::launch::async,
                       [&ct = patient.ct] { return std::make_unique<OriginalSurface>(ct.grid, ct.solid); });
  if (waits) surface_ = coming_.get();
}

void CoachFollower::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, const Known& known) {
  CoachContext context{.is_other_instrument = known.is_other_instrument, .is_out_of_sight = known.is_out_of_sight};
  for (const std::optional<double>& one : known.clearances)
    if (one && (!context.nearest_mm || *one < *context.nearest_mm)) context.nearest_mm = one;
  if (coming_.valid() && coming_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    surface_ = coming_.get();
  for (const haptics::Tick& tick : ticks) coach_.add(workSample(tick, command, surface_.get()), context);
}

std::optional<std::string> CoachFollower::news() {
  std::optional<std::string> says = coach_.take();
  if (says) event_log_.note(kCoachEvent, *says);
  return says;
}

}  // namespace app
