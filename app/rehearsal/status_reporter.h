// Who is told how a rehearsal stands, and how often: the surgeon by the window's title, the event_log of what is new of
// safety, device, recording and latency, both twice a second; the instructor ten times a second; all of them at the end.
// Main thread, once a frame; microseconds until something is due.
#pragma once

#include <optional>

#include "app/instructor/instructor_display.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/live_view.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/rehearsal_summary.h"
#include "app/rehearsal/run_monitor.h"

namespace app {

class StatusReporter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Borrows them all; goes before the picture, whose window the instructor's shares with. Opens the instructor's window
  /// where the plan has one.
  StatusReporter(const RehearsalPlan& plan, Equipment& equipment, LiveView& picture, RunMonitor& monitor,
                 EventLog& event_log);

  struct FrameState {
    const haptics::Tick& newest;
    const haptics::Command& in_force;
    const render::Layers& layers;
  };
  RehearsalStatus status(const FrameState& moment);
  void show(Time now, const FrameState& moment);
  /// While the surgeon's picture is on its way. What the instructor requests now.
  InstructorDisplay::Input updateInstructor(const FrameState& moment);
  /// Why it ended and how punctual it was, before the station stops.
  void reportEnd(Ending ending);
  /// How it stands after that; times and recording are left out.
  RehearsalFigures figures(const FrameState& moment);

 private:
  const RehearsalPlan& plan_;
  Equipment& equipment_;
  LiveView& view_;
  RunMonitor& monitor_;
  EventLog& event_log_;
  std::optional<InstructorDisplay> instructor_;
  Time shown_ = {}, latency_noted_ = {};
};

}  // namespace app
