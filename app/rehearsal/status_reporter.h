// Reports the state of a rehearsal: to the event log (news of safety, device,
// recording and latency) twice a second, to the instructor ten times a second, to all at the end. Main thread, once a
// frame; microseconds while nothing is due.
#pragma once

#include <optional>

#include "app/instructor/instructor_window.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/head_up.h"
#include "app/rehearsal/live_view.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/rehearsal_summary.h"
#include "app/rehearsal/run_monitor.h"

namespace app {

class StatusReporter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Borrows all; must be destroyed before the view, whose window shares with the instructor's. Opens the instructor's
  /// window if the plan has one.
  StatusReporter(const RehearsalPlan& plan, Equipment& equipment, LiveView& view, RunMonitor& monitor,
                 EventLog& event_log);

  struct FrameState {
    const haptics::Tick& newest;
    const haptics::Command& in_force;
    const render::Layers& layers;
    const HeadUp& head_up;
    std::string question;  ///< to the surgeon
    const std::optional<render::BoneGap>& gap;
    std::string ruler;  ///< rulerText()
    std::string way;    ///< WayFollower::line()
    haptics::Clearances clearances = {};
    StrokeTimes strokes = {};
    std::vector<MeasureValue> measures = {};
    std::array<std::optional<ClearanceMeasures::Least>, assets::kRiskStructures> least = {};
  };
  RehearsalStatus status(const FrameState& state);
  void update(Time now, const FrameState& state);
  /// Called while the surgeon's frame is queued. Returns the instructor's input.
  InstructorWindow::Input updateInstructor(const FrameState& state);
  /// Reason of the end, latency, timing and trips; before the station stops.
  void reportEnd(Ending ending);
  /// After the end, without times and recording.
  RehearsalFigures figures(const FrameState& state);

 private:
  const RehearsalPlan& plan_;
  Equipment& equipment_;
  LiveView& view_;
  RunMonitor& monitor_;
  EventLog& event_log_;
  std::optional<InstructorWindow> instructor_;
  std::uint64_t frames_ = 0;
  double frames_per_s_ = 0.0;
  Time updated_ = {}, latency_noted_ = {};
};

}  // namespace app
