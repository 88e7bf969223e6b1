#include "app/rehearsal/status_reporter.h"

#include <utility>

#include "app/options/tool_text.h"
#include "app/session/session_conditions.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kUpdateInterval{500};
constexpr std::chrono::seconds kLatencyInterval{5};

}  // namespace

StatusReporter::StatusReporter(const RehearsalPlan& plan, Equipment& equipment, LiveView& view, RunMonitor& monitor,
                               EventLog& event_log)
    : plan_(plan), equipment_(equipment), view_(view), monitor_(monitor), event_log_(event_log) {
  if (!plan.instructor_window) return;
  instructor_.emplace(view.display(), plan.rig, plan.monitor.value_or(0), event_log.reporter("display"));
  instructor_->setPanoramic(PanoramicPicture::of(plan.patient));
}

RehearsalStatus StatusReporter::status(const FrameState& state) {
  RehearsalStatus s;
  s.patient_title = plan_.patient.shownTitle();
  s.calibration = plan_.calibration;
  s.remarks = plan_.remarks;
  if (plan_.recording) {
    s.recording = RecordingState::running;
    s.recording_path = plan_.recording->path;
  }
  s.tick = state.newest;
  s.command = state.in_force;
  s.layers = state.layers;
  s.cutting_s = state.head_up.times().cutting_s;
  s.dry_s = state.head_up.times().dry_s;
  s.said = state.head_up.lastSaid();
  s.ruler = state.ruler;
  s.proposed = plan_.patient.proposed();
  s.clearances = state.clearances;
  s.measures = state.measures;
  s.least = state.least;
  s.way = state.way;
  s.strokes = state.strokes;
  if (state.gap) s.gap_mm = state.gap->mm;
  if (plan_.procedure) {
    const ProcedureMessages messages = plan_.procedure->messages();
    s.to_surgeon = messages.to_surgeon;
    s.to_instructor = messages.to_instructor;
  }
  if (plan_.evaluation) {
    s.to_surgeon = plan_.evaluation->toSurgeon();
    s.to_instructor = plan_.evaluation->toEvaluator();
  }
  if (!state.question.empty()) s.to_surgeon = state.question;
  s.device = equipment_.deviceName();
  s.has_motors = equipment_.hasMotors();
  s.servo = equipment_.workstation().figures();
  s.servo_rate_Hz = equipment_.rate_Hz();
  s.frames_per_s = frames_per_s_;
  view_.describe(s);
  monitor_.describe(s);
  return s;
}

void StatusReporter::update(Time now, const FrameState& state) {
  if (now - updated_ < kUpdateInterval) return;
  const double since_s = std::chrono::duration<double>(now - updated_).count();
  frames_per_s_ = static_cast<double>(view_.frames() - std::exchange(frames_, view_.frames())) / since_s;
  updated_ = now;
  // Of forces that nobody feels the record is told alone.
  const bool is_felt = equipment_.hasMotors() || plan_.verbose || plan_.headless;
  for (const Notice& notice : monitor_.takeNotices(equipment_.health(), state.newest, state.in_force.hands_off))
    if (notice.kind == kSafetyNotice && !is_felt)
      event_log_.note(notice.kind, notice.line);
    else
      event_log_.report(notice);
  render::Window* const window = view_.window();
  if (window == nullptr) return;
  if (now - latency_noted_ > kLatencyInterval && view_.latency().frames() > 0) {
    latency_noted_ = now;
    event_log_.note("latency", latencyText(view_.latency().now()));
  }
  window->setTitle(plan_.patient.shownTitle());
}

InstructorWindow::Input StatusReporter::updateInstructor(const FrameState& state) {
  if (!instructor_) return {};
  instructor_->reopenAfterReset();
  return instructor_->isDue() ? instructor_->draw(status(state)) : InstructorWindow::Input{};
}

void StatusReporter::reportEnd(Ending ending) {
  if (ending == Ending::silent)
    event_log_.report(
        {"device", "the device has not ticked for 10 s, so the rehearsal ends; check its cable and driver"});
  if (view_.latency().frames() > 0) event_log_.note("latency", "median " + latencyText(view_.latency().median()));
  Workstation& station = equipment_.workstation();
  event_log_.note("end", textOf(ending));
  event_log_.note(kServoEvent, punctualityText(station.figures()));
  event_log_.note("safety", "trips: " + tripsText(station.trips()));
}

RehearsalFigures StatusReporter::figures(const FrameState& state) {
  RehearsalFigures figures;
  figures.ticking = plan_.ticking;
  figures.for_engineers = plan_.verbose || plan_.headless;
  figures.has_motors = equipment_.hasMotors();
  figures.last = status(state);
  figures.last.trips = equipment_.workstation().trips();
  figures.removed_mm3 = equipment_.workstation().bodies().removedByTissue_mm3();
  figures.frames = view_.frames();
  if (view_.latency().frames() > 0) {
    figures.latency = view_.latency().median();
    figures.slow_latency = view_.latency().slow();
  }
  return figures;
}

}  // namespace app
