// The coach during a rehearsal: reads the ticks as the measures do, and makes of what it says a line for the surgeon
// and an event of the recording. The bone's surface is found on a worker; until then nothing is said of plunging. Main
// thread, once a frame; a microsecond a tick.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/procedure/coach/coach.h"
#include "app/rehearsal/event_log.h"
#include "app/session/measures/original_surface.h"
#include "assets/patient.h"
#include "haptics/tool/clearance.h"

namespace app {

class CoachFollower {
 public:
  /// Borrows patient and log. `waits`: for the surface, so that a stepped rehearsal says the same each time.
  CoachFollower(CoachRules rules, const assets::Patient& patient, EventLog& event_log, bool waits);

  /// What is known of the newest tick beside it.
  struct Known {
    haptics::Clearances clearances;
    bool is_other_instrument = false;  ///< than the step's
    bool is_out_of_sight = false;
  };
  /// All ticks, in order, made with this command.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, const Known& known);
  std::optional<std::string> news();

 private:
  Coach coach_;
  EventLog& event_log_;
  std::future<std::unique_ptr<OriginalSurface>> coming_;
  std::unique_ptr<OriginalSurface> surface_;
};

}  // namespace app
