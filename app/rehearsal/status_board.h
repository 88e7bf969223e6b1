// Who is told how a rehearsal stands, and how often: the surgeon by the window's title, the journal of what is new of
// safety, device, recording and latency, both twice a second; the operator ten times a second; all of them at the end.
// Main thread, once a frame; microseconds until something is due.
#pragma once

#include <optional>

#include "app/instructor/operator_seat.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/journal.h"
#include "app/rehearsal/live_picture.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/rehearsal_summary.h"
#include "app/rehearsal/run_monitor.h"

namespace app {

class StatusBoard {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Borrows them all; goes before the picture, whose window the operator's shares with. Opens the operator's window
  /// where the plan has one.
  StatusBoard(const RehearsalPlan& plan, Equipment& equipment, LivePicture& picture, RunMonitor& monitor,
              Journal& journal);

  struct Moment {
    const haptics::Tick& newest;
    const haptics::Command& in_force;
    const render::Layers& layers;
  };
  RehearsalStatus status(const Moment& moment);
  void show(Time now, const Moment& moment);
  /// While the surgeon's picture is on its way. What the operator wishes now.
  OperatorSeat::Heard serveOperator(const Moment& moment);
  /// Why it ended and how punctual it was, before the station stops.
  void tellEnd(Ending ending);
  /// How it stands after that; times and recording are left out.
  RehearsalFigures figures(const Moment& moment);

 private:
  const RehearsalPlan& plan_;
  Equipment& equipment_;
  LivePicture& picture_;
  RunMonitor& monitor_;
  Journal& journal_;
  std::optional<OperatorSeat> operator_;
  Time shown_ = {}, latency_noted_ = {};
};

}  // namespace app
