#include "app/rehearsal/rehearsal.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "app/controls/active_command.h"
#include "app/rehearsal/control_router.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/fast_pace.h"
#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/interrupt.h"
#include "app/rehearsal/pace.h"
#include "app/rehearsal/rehearsal_outputs.h"
#include "app/rehearsal/run_monitor.h"
#include "app/rehearsal/status_reporter.h"
#include "app/text/message.h"

namespace app {
namespace {

/// One rehearsal from the first frame on.
class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        equipment_(plan_),
        active_command_(plan_.command, plan_.other_tools, plan_.parameters, equipment_.damping_Ns_per_mm(),
                        equipment_.rate_Hz()),
        duration_s_(plan_.seconds ? plan_.seconds : equipment_.duration_s()),
        monitor_(duration_s_),
        router_(plan_, equipment_, active_command_, monitor_, view_, event_log_),
        view_(plan_, active_command_.inForce(), equipment_.secondHand(), equipment_.rate_Hz(),
              [this](const std::string& line) {
                event_log_.report({"display", line});
              }),
        frame_(openingFrame(plan_)) {
    // Pictures with a name are claimed before the work.
    if (!plan_.snapshot.empty()) last_.emplace(plan_.snapshot, plan_.overwrite);
    if (!plan_.first_snapshot.empty()) first_.emplace(plan_.first_snapshot, plan_.overwrite);
    if (plan_.recording) plan_.recording->calibration = plan_.calibration;
    equipment_.join(plan_, active_command_.inForce());
    active_command_.serve(station());
    pace_ = paceOf();
    view_.follow(station().bone());
    status_reporter_.emplace(plan_, equipment_, view_, monitor_, event_log_);
  }

  /// However it ends: the force goes first, then windows.
  ~Rehearsal() { station().stop(); }
  Rehearsal(const Rehearsal&) = delete;
  Rehearsal& operator=(const Rehearsal&) = delete;

  int run() {
    for (const std::string& remark : plan_.remarks) printMessage(remark);
    if (const auto beside = station().temporaryFile())
      printMessage("recording into " + *beside + " until it is closed, then in the place of " + plan_.recording->path);
    double first_picture_s = 0.0;
    if (pace_->isRealTime()) {
      view_.show(frame_);
      first_picture_s = secondsSince(plan_.begun);
      // Before the hand is there.
      view_.settle(frame_);
    }
    if (first_) view_.take(*first_, frame_, plan_.patient.ct.solid);
    start();
    const Pace::Time looping_since = pace_->now();
    const std::uint64_t settled = view_.pictures();
    std::optional<Ending> ending;
    while (router_.handleInput(newest_, frame_), !(ending = endingNow())) {
      // When a file was changed is the wall's time.
      if (pace_->isRealTime()) active_command_.pollSettingsFile(pace_->now());
      followProcedure();
      if (active_command_.takeToolChange() && pace_->isRealTime()) view_.showInstrument();
      pace_->toNextFrame();
      followServo();
      if (pace_->isRealTime()) view_.show(frame_);
      if (view_.adaptQuality(newest_.drilling || newest_.depth_mm > 0.0)) noteQuality();
      status_reporter_->show(pace_->now(), moment());
      router_.handleInstructorInput(status_reporter_->updateInstructor(moment()), frame_);
    }
    const double loop_s = secondsSince(looping_since);
    RehearsalFigures figures = finish(*ending);
    figures.first_picture_s = first_picture_s;
    figures.frame_ms = 1000.0 * loop_s / static_cast<double>(std::max<std::uint64_t>(1, figures.frames - settled));
    std::fputs(summaryText(figures).c_str(), plan_.procedure ? stderr : stdout);
    return exitStatus(figures);
  }

 private:
  std::unique_ptr<Pace> paceOf() {
    if (plan_.ticking == Ticking::realtime) return std::make_unique<RealPace>(view_);
    return std::make_unique<FastPace>(station(), equipment_.secondHand(), router_.script(), equipment_.rate_Hz(),
                                      duration_s_);
  }

  Workstation& station() { return equipment_.workstation(); }
  double secondsSince(Pace::Time start) const { return std::chrono::duration<double>(pace_->now() - start).count(); }

  void start() {
    equipment_.start();
    for (const std::string& remark : plan_.remarks) station().note("calibration", remark);
    event_log_.recordInto(station());
    noteQuality();
  }

  std::optional<Ending> endingNow() {
    return monitor_.ending(newest_, pace_->now(), isInterrupted(), plan_.procedure && plan_.procedure->isOver(),
                           !station().isApplied(newest_));
  }

  void followProcedure() {
    if (!plan_.procedure) return;
    const std::vector<haptics::Tick> ticks = station().takeTicks();
    if (ticks.empty()) return;
    if (const auto wanted = plan_.procedure->follow(ticks)) active_command_.follow(*wanted);
  }

  /// The tick first, then the bricks: what that tick cut is in this very frame.
  void followServo() {
    newest_ = station().newestTick();
    frame_ = nextFrame(frame_, newest_, active_command_.inForce());
    if (equipment_.secondHand()) equipment_.secondHand()->place(frame_);
    if (pace_->isRealTime()) view_.uploadBone();
  }

  void noteQuality() { event_log_.note("quality", view_.qualityText()); }

  StatusReporter::FrameState moment() const { return {newest_, active_command_.inForce(), frame_.layers}; }

  RehearsalFigures finish(Ending ending) {
    status_reporter_->reportEnd(ending);
    const RecordingSummary recorded = station().stop();
    // One more picture of what the bone has become.
    followServo();
    if (last_)
      view_.take(*last_, closingFrame(frame_, newest_, equipment_.mouse() != nullptr),
                 station().bone().solidInGridOrder());
    RehearsalFigures figures = status_reporter_->figures(moment());
    if (plan_.recording) figures.recording = recorded;
    return figures;
  }

  RehearsalPlan plan_;
  EventLog event_log_;
  Equipment equipment_;
  ActiveCommand active_command_;
  std::optional<double> duration_s_;
  RunMonitor monitor_;
  ControlRouter router_;
  std::optional<StereoSnapshot> first_, last_;
  LiveView view_;
  std::unique_ptr<Pace> pace_;
  std::optional<StatusReporter> status_reporter_;  // goes before the picture
  render::Frame frame_;
  haptics::Tick newest_;
};

}  // namespace

int rehearse(RehearsalPlan plan) {
  installInterruptHandlers();
  plan.device_options.given_up = [] { return isInterrupted(); };
  return Rehearsal(std::move(plan)).run();
}

}  // namespace app
