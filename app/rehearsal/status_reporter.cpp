#include "app/rehearsal/status_reporter.h"

#include "app/options/tool_text.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kShownEvery{500};
constexpr std::chrono::seconds kLatencyNotedEvery{5};

}  // namespace

StatusReporter::StatusReporter(const RehearsalPlan& plan, Equipment& equipment, LiveView& picture, RunMonitor& monitor,
                               EventLog& event_log)
    : plan_(plan), equipment_(equipment), view_(picture), monitor_(monitor), event_log_(event_log) {
  if (plan.instructor_window)
    instructor_.emplace(picture.display(), plan.rig, plan.monitor.value_or(0), [&event_log](const std::string& line) {
      event_log.report({"display", line});
    });
}

RehearsalStatus StatusReporter::status(const FrameState& moment) {
  RehearsalStatus s = statusOf(plan_);
  s.bur = textOf(moment.in_force.tool.head);
  s.tick = moment.newest;
  s.command = moment.in_force;
  s.layers = moment.layers;
  if (plan_.procedure) {
    const ProcedureMessages words = plan_.procedure->words();
    s.to_surgeon = words.to_surgeon;
    s.to_instructor = words.to_instructor;
  }
  equipment_.describe(s);
  view_.describe(s);
  monitor_.describe(s);
  return s;
}

void StatusReporter::show(Time now, const FrameState& moment) {
  if (now - shown_ < kShownEvery) return;
  shown_ = now;
  view_.measureRate(now);
  for (const Notice& notice : monitor_.look(equipment_.health(), moment.newest)) event_log_.report(notice);
  render::Window* const window = view_.window();
  if (window == nullptr) return;
  if (now - latency_noted_ > kLatencyNotedEvery && view_.latency().pictures() > 0) {
    latency_noted_ = now;
    event_log_.note("latency", latencyText(view_.latency().now()));
  }
  window->setTitle(statusLine(status(moment)));
}

InstructorDisplay::Input StatusReporter::updateInstructor(const FrameState& moment) {
  if (!instructor_) return {};
  instructor_->reopenAfterReset();
  return instructor_->isDue() ? instructor_->serve(status(moment)) : InstructorDisplay::Input{};
}

void StatusReporter::reportEnd(Ending ending) {
  if (ending == Ending::silent)
    event_log_.report(
        {"device", "the device has not ticked for 10 s, so the rehearsal ends; check its cable and driver"});
  if (view_.latency().pictures() > 0) event_log_.note("latency", "median " + latencyText(view_.latency().median()));
  Workstation& station = equipment_.workstation();
  event_log_.note("end", textOf(ending));
  event_log_.note("servo", punctualityText(station.figures()));
  event_log_.note("safety", "trips: " + tripsText(station.trips()));
}

RehearsalFigures StatusReporter::figures(const FrameState& moment) {
  RehearsalFigures figures;
  figures.ticking = plan_.ticking;
  figures.last = status(moment);
  figures.last.trips = equipment_.workstation().trips();
  figures.removed_mm3 = equipment_.workstation().bone().removedByTissue_mm3();
  view_.describe(figures);
  return figures;
}

}  // namespace app
