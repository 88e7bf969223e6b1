#include "app/rehearsal/rehearsal.h"

#include <algorithm>
#include <csignal>
#include <utility>

#include <fmt/core.h>

#include "app/case/enamel_exposure.h"
#include "app/controls/active_command.h"
#include "app/device/emergency_exit.h"
#include "app/device/pose_sources.h"
#include "app/options/bur_name.h"
#include "app/procedure/third_molar/demonstration.h"
#include "app/rehearsal/clearance_watch.h"
#include "app/rehearsal/coach_follower.h"
#include "app/rehearsal/control_router.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/live_measures.h"
#include "app/rehearsal/operated_site.h"
#include "app/rehearsal/pace.h"
#include "app/rehearsal/ruler.h"
#include "app/rehearsal/sight_watch.h"
#include "app/rehearsal/single_tooth_site.h"
#include "app/rehearsal/soft_mark_trail.h"
#include "app/rehearsal/start_pose.h"
#include "app/rehearsal/status_reporter.h"
#include "app/rehearsal/step_follower.h"
#include "app/rehearsal/touches.h"
#include "app/session/assessment_event.h"
#include "app/session/soft_touches.h"
#include "app/sound/live_sound.h"

namespace app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// They end a rehearsal in order; at the second signal the force goes to zero at once.
void installInterruptHandlers() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, [](int) {
      if (interrupted) forbidForceNow();
      interrupted = 1;
    });
}

class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        equipment_(plan_),
        active_command_(plan_.command, plan_.other_tools, plan_.parameters, equipment_.damping_Ns_per_mm(),
                        equipment_.rate_Hz()),
        duration_s_(plan_.seconds ? plan_.seconds : equipment_.duration_s()),
        monitor_(duration_s_),
        head_up_(plan_.head_up_line, plan_.verbose),
        router_(plan_, equipment_, active_command_, monitor_, view_, head_up_, event_log_),
        view_(plan_, active_command_.inForce(), equipment_.secondHand(), equipment_.rate_Hz(),
              event_log_.reporter("display")),
        pace_(plan_.ticking, equipment_, view_, router_.script(), duration_s_),
        frame_(openingFrame(plan_)),
        clarity_(openingClarity(plan_)) {
    // Output files are claimed before the work.
    if (!plan_.snapshot.empty()) last_.emplace(plan_.snapshot, plan_.overwrite);
    if (!plan_.first_snapshot.empty()) first_.emplace(plan_.first_snapshot, plan_.overwrite);
    if (plan_.recording) plan_.recording->calibration = plan_.calibration;
    equipment_.connect(plan_, active_command_.inForce());
    active_command_.attach(station());
    active_command_.speakTo([this](const std::string& line) { head_up_.say(line); });
    view_.attach(station().bodies());
    site_.emplace(OperatedSite::Links{plan_, station(), active_command_, head_up_, event_log_, !pace_.isRealTime()});
    if (plan_.procedure_steps) steps_.emplace(plan_, station().bodies(), event_log_);
    if (plan_.instructor_window) measures_.emplace(plan_.patient.ct, !pace_.isRealTime());
    tooth_.emplace(SingleToothSite::Links{plan_, station().bodies(), head_up_, event_log_, pace_.isRealTime()});
    if (plan_.coach) coach_.emplace(*plan_.coach, plan_.patient, event_log_, !pace_.isRealTime());
    if (plan_.evaluation) plan_.evaluation->open(plan_.risks, station().recordingFile().value_or(""));
    if (equipment_.led() != nullptr) beginOperation();
    status_reporter_.emplace(plan_, equipment_, view_, monitor_, event_log_);
  }

  /// The force goes to zero before the windows close, also after an exception.
  ~Rehearsal() { station().stop(); }
  Rehearsal(const Rehearsal&) = delete;
  Rehearsal& operator=(const Rehearsal&) = delete;

  int run() {
    const double first_frame_s = showFirstFrame();
    start();
    const Pace::Time loop_start = pace_.now();
    const std::uint64_t frames_before = view_.frames();
    for (;;) {
      router_.handleInput(newest_, frame_);
      followSteps();
      if (const std::optional<Ending> ending = endingNow()) {
        const double loop_s = secondsSince(loop_start);
        RehearsalFigures figures = finish(*ending);
        figures.first_frame_s = first_frame_s;
        figures.frame_ms = 1000.0 * (loop_s - view_.still_s()) /
                           static_cast<double>(std::max<std::uint64_t>(1, figures.frames - frames_before));
        std::fputs((plan_.summary ? summaryText(figures) : recordingText(figures)).c_str(),
                   plan_.procedure || plan_.evaluation ? stderr : stdout);
        return std::max(exitStatus(figures), demonstrationStatus());
      }
      updateCommand();
      pace_.toNextFrame();
      readServo();
      followSite();
      followDemonstration();
      draw();
      tellSpectator();
      updateMeasures();
      status_reporter_->update(pace_.now(), state());
      router_.handleInstructorInput(status_reporter_->updateInstructor(state()), frame_);
    }
  }

 private:
  Workstation& station() { return equipment_.workstation(); }
  double secondsSince(Pace::Time start) const { return std::chrono::duration<double>(pace_.now() - start).count(); }
  StatusReporter::FrameState state() const {
    return {newest_,    active_command_.inForce(),    frame_.layers,    head_up_,         router_.question(),
            frame_.gap, rulerText(frame_.ruler),      site_->wayLine(), clearance_.now(), stroke_times_,
            measured_,  clearance_.measures().least()};
  }

  void beginOperation() {
    const std::vector<haptics::Tool>& tray = active_command_.tray();
    const Demonstration::Site site{plan_.patient, plan_.cut.value(), tray, station().bodies(), *equipment_.led()};
    const Flap* const flap = site_->flap();
    if (flap == nullptr) return void(demonstration_.emplace(site));
    FlapWork work(flap->chart(), flap->plan(), tray, Demonstration::heldAtGutter(*plan_.cut, tray.front()));
    if (plan_.shows_whole_operation)
      demonstration_.emplace(site, std::move(work));
    else
      demonstration_.emplace(Demonstration::ofFlap(site, std::move(work)));
  }

  /// Before the servo starts. Returns the seconds from the user's command to the first frame.
  double showFirstFrame() {
    for (const std::string& remark : plan_.remarks) printMessage(remark);
    if (const auto temporary = station().temporaryFile())
      printMessage("recording to " + *temporary + " until it is closed, then replacing " + plan_.recording->path);
    double first_frame_s = 0.0;
    if (pace_.isRealTime()) {
      if (plan_.laid) view_.uploadBone(frame_);
      view_.setHeadUp(head_up_.content(headUpValues(), pace_.now()));
      view_.showLive(frame_);
      first_frame_s = secondsSince(plan_.begun);
      view_.settleQuality(frame_);
    }
    if (first_) view_.takeSnapshot(*first_, frame_, plan_.patient.ct.solid);
    return first_frame_s;
  }

  /// A mouse's tool begins a little off the bone, and its user is told which way is in.
  void placeMouse() {
    if (equipment_.mouse() == nullptr) return;
    const assets::Patient& patient = plan_.patient;
    if (patient.canals || patient.prepared) {
      const calibration::Point<calibration::Patient> over{
          patient.canals ? startOverCrown_P_mm(*patient.canals) : startOverCrown_P_mm(*patient.prepared, patient.ct)};
      router_.placeHandAt((plan_.rig.X_WP * over).mm);
      return head_up_.say("over the crown: the wheel goes in along the instrument");
    }
    render::Frame held = frame_;
    held.X_PT.rotation = plan_.rig.X_WP.inverse().rotation * restingTool(plan_.rig, plan_.patient, plan_.cut).rotation;
    held.tool_visible = true;
    const GapOf gap_of = [this](const render::Frame& frame) { return view_.gapOf(frame); };
    const auto start_W_mm = plan_.cut ? startBeforePlan(held, *plan_.cut, gap_of)
                                      : startBeforeBone(held, plan_.patient.focus_P_mm(), gap_of);
    if (!start_W_mm) return;
    router_.placeHandAt(*start_W_mm);
    head_up_.say(fmt::format("{:.0f} mm off the bone: wheel away from you goes in", kStartGap_mm));
  }

  void start() {
    placeMouse();
    equipment_.start();
    for (const std::string& remark : plan_.remarks) station().note("calibration", remark);
    if (plan_.recording && plan_.recording->setup.former)
      station().note("continues", plan_.recording->setup.former->file);
    event_log_.recordInto(station());
    event_log_.note("quality", view_.qualityText());
    event_log_.note(kTouchEvent, kTouchCounting);
    sight_.noteEyes(frame_.rig);
    if (plan_.is_assessed) {
      event_log_.note(kAssessmentEvent, std::string(kAssessmentRules));
      head_up_.say("assessment: nothing helps, everything is recorded");
    }
    tooth_->start();
    if (steps_) steps_->start();
    if (pace_.isRealTime() && plan_.sound && !plan_.headless) sound_.emplace(plan_.played);
  }

  void followSound() {
    const std::optional<int> asked = router_.takeSound();
    if (asked && !sound_) head_up_.say("there is no sound in this rehearsal");
    if (!sound_) return;
    if (asked) {
      sound_->mute(*asked == kNoValue ? !sound_->isMuted() : *asked == 0);
      head_up_.say(sound_->isMuted() ? "sound off" : "sound on");
    }
    if (const std::string trouble = sound_->takeTrouble(); !trouble.empty()) printMessage(trouble);
  }

  std::optional<Ending> endingNow() {
    return monitor_.ending(newest_, pace_.now(), interrupted != 0, isProcedureOver(), !station().isApplied(newest_));
  }

  bool isProcedureOver() const {
    return (plan_.procedure && plan_.procedure->isOver()) || (plan_.evaluation && plan_.evaluation->isOver()) ||
           (plan_.spectator && plan_.spectator->endsRehearsal()) || (demonstration_ && demonstration_->isOver());
  }

  /// 1: the tooth could not be taken out.
  int demonstrationStatus() const {
    const std::string failure = demonstration_ ? demonstration_->failure() : "";
    if (failure.empty()) return 0;
    printMessage("the operation was not finished: " + failure);
    return 1;
  }

  void updateCommand() {
    // A stepped rehearsal has no wall clock by which a file could change.
    if (pace_.isRealTime()) active_command_.pollSettingsFile(pace_.now());
    followTicks();
    followSound();
    if (const auto says = coach_ ? coach_->news() : std::nullopt) head_up_.say(*says);
    active_command_.followStrokes(newest_);
    if (active_command_.takeToolChange() && pace_.isRealTime()) view_.showInstrument();
  }

  /// All of them, also those between two frames.
  void followTicks() {
    const std::vector<haptics::Tick> ticks = station().takeTicks();
    if (ticks.empty()) return;
    const haptics::Command& command = active_command_.inForce();
    countSoftTouches(ticks);
    site_->follow(ticks);
    if (sound_) sound_->follow(ticks, command, soundWarningNow());
    if (measures_) measures_->follow(ticks, command, station().commandSerial());
    stroke_times_.follow(ticks);
    soft_marks_.follow(ticks, command.tool.head);
    head_up_.follow(ticks, command.irrigating);
    tooth_->follow(ticks, command.tool);
    clearance_.follow(ticks, command, station().commandSerial());
    if (steps_) steps_->follow(ticks, command, site_->bridge_mm(), site_->socket(), site_->flapFacts());
    if (coach_)
      coach_->follow(ticks, command,
                     {clearance_.now(), steps_ && steps_->usesOtherInstrument(),
                      sight_.worksOutOfSight(ticks, command, station().bodies().grid(), site_->solidInMouth())});
    if (plan_.evaluation) followEvaluation(ticks, command);
    for (const Touch& touch : touches_.follow(ticks, command.tool)) noteTouch(touch);
    if (!plan_.procedure) return;
    if (const auto wanted = plan_.procedure->follow(ticks)) active_command_.adopt(*wanted);
  }

  SoundWarning soundWarningNow() const {
    SoundWarning now = plan_.sounds_clearance ? soundWarning(clearance_.now()) : SoundWarning();
    if (const auto& told = tooth_->located()) now.apex = apexTone(told->left_mm, told->is_apex);
    return now;
  }

  /// Marks go into the recording, words do not.
  void followEvaluation(std::span<const haptics::Tick> ticks, const haptics::Command& command) {
    EvaluationDesk& desk = *plan_.evaluation;
    // It waits for who follows by what is written.
    if (!pace_.isRealTime()) station().write();
    desk.follow(ticks, command, station().commandSerial());
    for (const ControlRequest& request : desk.takeRequests()) active_command_.execute(request);
    for (const std::string& mark : desk.takeMarks()) event_log_.note(kEvaluationEvent, mark);
  }

  /// For the instructor, twice a second.
  void updateMeasures() {
    constexpr std::chrono::milliseconds kBetween{500};
    if (!measures_ || pace_.now() - measured_at_ < kBetween) return;
    measured_at_ = pace_.now();
    measured_ = measures_->values();
  }

  void noteTouch(const Touch& touch) {
    event_log_.note(kTouchEvent, touchText(touch));
    if (steps_) steps_->follow(touch);
  }

  /// What the surgeon asks of a stepped procedure, and what it says.
  void followSteps() {
    const int skipped = router_.takeSteps();
    if (!steps_) return;
    for (int n = 0; n < skipped; ++n) head_up_.say(steps_->skip());
    if (const auto answer = router_.takePrediction())
      steps_->predict(answer->difficulty, answer->minutes, newest_.t_s + newest_.dt_s);
    while (const auto line = steps_->news()) head_up_.say(*line);
    const bool shows = steps_->showsGutter();
    if (shows != shows_gutter_) frame_.layers.planned_cut = shows_gutter_ = shows;
  }

  void countSoftTouches(const std::vector<haptics::Tick>& ticks) {
    for (const haptics::Tick& tick : ticks) soft_touches_.add(tick);
    for (const std::string& line : soft_touches_.takeEvents()) event_log_.note("soft tissue", line);
  }

  /// The tick before the bricks: bone that a tick removed is in the same frame as its pose.
  void readServo() {
    newest_ = station().newestTick();
    clearance_.update(newest_, active_command_.inForce().tool);
    frame_ = nextFrame(frame_, newest_, active_command_.inForce());
    clarity_.step(newest_, active_command_.inForce().irrigating);
    frame_.field = surgicalField(clarity_);
    frame_.marks = soft_marks_.marks();
    sight_.followHand(equipment_.secondHand(), newest_, active_command_.inForce().irrigating, frame_);
    frame_.pieces = movedPieces(newest_);
    tooth_->followHand(newest_, active_command_.inForce(), frame_);
    if (const auto lying = tooth_->takeFragments()) view_.showFragments(*lying);
    view_.showFile(newest_, frame_);
    if (!pace_.isRealTime()) return;
    view_.uploadBone(frame_);
    frame_.gap = view_.gapOf(frame_);
  }

  void followSite() {
    const std::vector<glm::ivec3> changed = view_.takeChangedBricks();
    const std::vector<std::optional<glm::dvec3>> drawn = router_.takeDrawn();
    // The shown operation was planned for crumbs that stay where they are: a piece's way out hangs on them. Once the
    // tooth is out they are taken.
    const bool may_loosen = !demonstration_ || demonstration_->isToothOut();
    site_->follow({changed, newest_, drawn, router_.takeWay(), demonstration_.has_value(), may_loosen}, frame_);
    if (router_.takeBites() > 0) tooth_->bite(newest_);
    tooth_->followBone(changed, newest_, frame_);
    if (steps_) steps_->followBone(changed, newest_.t_s, !pace_.isRealTime());
  }

  void tellStep(const std::string& line) {
    head_up_.say(line);
    event_log_.note("procedure", line);
    if (plan_.verbose || plan_.headless) printMessage(fmt::format("at {:.1f} s {}", newest_.t_s, line));
  }

  void followDemonstration() {
    if (!demonstration_) return;
    const haptics::Command& command = active_command_.inForce();
    const Demonstration::Frame frame{newest_,
                                     command.tool,
                                     command.drill_enabled,
                                     station().isApplied(newest_),
                                     site_->isReady(),
                                     !pace_.isRealTime(),
                                     site_->flap() != nullptr && site_->flap()->isAside() && command.flap_aside,
                                     site_->left()};
    if (const auto request = demonstration_->follow(frame)) active_command_.execute(*request);
    while (const auto line = demonstration_->news()) tellStep(*line);
  }

  /// Some tenths of a second: once, at the end.
  std::optional<double> exposedShare() {
    const assets::Patient& patient = plan_.patient;
    if (!plan_.cut || !patient.site) return {};
    const std::vector<std::uint8_t>& before = plan_.scanned_solid.empty() ? patient.ct.solid : plan_.scanned_solid;
    const EnamelExposure exposure(patient.ct, before, *patient.site, *plan_.cut);
    if (exposure.planned_mm2() <= 0.0) return {};
    return exposure.share(station().bodies().solidInMouth());
  }

  HeadUp::Values headUpValues() const {
    Situation situation = situationOf(newest_, active_command_.inForce(), plan_.patient, equipment_.hasMotors(),
                                      monitor_.recordingEnded());
    situation.jaw_N_per_mm2 = site_->jawStress().now_N_per_mm2();
    situation.root_N_per_mm2 = site_->rootStress().now_N_per_mm2();
    situation.is_crown = site_->rootStress().isCrown();
    situation.canal_mm = clearance_.canal_mm();
    situation.is_blind = !plan_.shows_clearance;
    situation.below_cusp_mm = tooth_->belowCusp_mm();
    const std::optional<LocatorTold>& told = tooth_->located();
    return {situation,
            frame_.gap ? std::optional(frame_.gap->mm) : std::nullopt,
            task(),
            rulerText(frame_.ruler),
            site_->isReady(),
            outcomeLine(),
            site_->wayLine(),
            ringShown(),
            plan_.shows_clearance ? clearance_.ruler(plan_.patient.proposed()) : std::vector<HeadUpClearance>(),
            true,
            tooth_->fileLine(newest_),
            told ? std::optional(HeadUpLocator{told->left_mm, told->is_apex}) : std::nullopt};
  }

  /// What the work has come to so far.
  std::string outcomeLine() const {
    if (std::string line = tooth_->outcomeLine(); !line.empty()) return line;
    return site_->socketLine();
  }

  HeadUpRing ringShown() const {
    const ToolRing& ring = router_.ring();
    HeadUpRing shown;
    if (!ring.isOpen()) return shown;
    for (const haptics::Tool& tool : active_command_.tray()) shown.names.push_back(toolName(tool));
    shown.in_hand = ring.inHand();
    shown.chosen = ring.chosen();
    shown.middle = ring.middle();
    return shown;
  }

  std::string task() const {
    if (plan_.procedure) return plan_.procedure->messages().to_surgeon;
    if (plan_.evaluation) return plan_.evaluation->toSurgeon();
    const std::string question = router_.question();
    if (!question.empty()) return question;
    return steps_ ? steps_->task() : plan_.instruction;
  }

  void draw() {
    sight_.noteEyes(frame_.rig);
    // Also without display: warnings are counted.
    view_.setHeadUp(head_up_.content(headUpValues(), pace_.now()));
    if (pace_.isRealTime()) view_.show(frame_, pace_.now());
    const bool in_stroke = newest_.drilling || newest_.depth_mm > 0.0;
    if (view_.adaptQuality(in_stroke)) event_log_.note("quality", view_.qualityText());
  }

  void tellSpectator() {
    if (!plan_.spectator || !pace_.isRealTime()) return;
    std::optional<double> nearest_mm;
    for (const std::optional<double>& one : clearance_.now())
      if (one && (!nearest_mm || *one < *nearest_mm)) nearest_mm = one;
    plan_.spectator->see({newest_, nearest_mm, equipment_.rate_Hz(), recording_trouble_, servo_figures_, picture_});
  }

  RehearsalFigures finish(Ending ending) {
    followTicks();
    for (const Touch& touch : touches_.finish()) noteTouch(touch);
    if (plan_.evaluation) {
      plan_.evaluation->finish();
      for (const std::string& mark : plan_.evaluation->takeMarks()) event_log_.note(kEvaluationEvent, mark);
    }
    tooth_->finish();
    if (steps_) steps_->finish();
    site_->finish(view_.takeChangedBricks(), station().newestTick());
    if (const std::string latency = sound_ ? sound_->latencyText() : ""; !latency.empty())
      event_log_.note("sound", latency);
    if (measures_) {
      measures_->finish();
      event_log_.note(kMeasuresEvent, measures_->text());
    }
    if (const std::string least = clearanceText(clearance_.measures()); least != "{}")
      event_log_.note(kClearanceEvent, least);
    status_reporter_->reportEnd(ending);
    const RecordingSummary recorded = station().stop();
    countSoftTouches(station().takeTicks());
    readServo();
    if (last_) tooth_->paintNow(frame_);
    if (last_ && (!plan_.evaluation || plan_.evaluation->allowsPictures()))
      view_.takeSnapshot(*last_, closingFrame(frame_, newest_, equipment_.mouse() != nullptr),
                         station().bodies().solidInGridOrder());
    RehearsalFigures figures = status_reporter_->figures(state());
    figures.times = head_up_.times();
    if (plan_.summary) figures.exposed_share = exposedShare();
    site_->describe(figures);
    if (steps_) figures.procedure = steps_->run(), figures.prediction = steps_->prediction();
    figures.canals = tooth_->canals();
    figures.touched = touches_.counts();
    figures.clearance = clearancesInWords(clearance_.measures(), plan_.patient.proposed());
    figures.warnings = head_up_.warnings().counts();
    figures.soft_touches = soft_touches_.counts();
    if (plan_.recording) figures.recording = recorded, figures.recorded_by_default = plan_.recording->by_default;
    return figures;
  }

  RehearsalPlan plan_;
  EventLog event_log_;
  Equipment equipment_;
  ActiveCommand active_command_;
  std::optional<double> duration_s_;
  RunMonitor monitor_;
  HeadUp head_up_;
  Touches touches_{plan_.patient, plan_.risks.of(assets::RiskStructure::canal)};
  ClearanceWatch clearance_{plan_.risks};
  ControlRouter router_;
  SightWatch sight_{plan_, event_log_};
  SoftTouchCounter soft_touches_;
  SoftMarkTrail soft_marks_;
  StrokeTimes stroke_times_;
  std::optional<StereoSnapshot> first_, last_;
  LiveView view_;
  Pace pace_;
  std::optional<StatusReporter> status_reporter_;  // destroyed before view_
  render::Frame frame_;
  std::optional<OperatedSite> site_;
  std::optional<SingleToothSite> tooth_;
  std::optional<StepFollower> steps_;
  std::optional<LiveSound> sound_;
  std::optional<CoachFollower> coach_;
  std::optional<LiveMeasures> measures_;
  std::vector<MeasureValue> measured_;  ///< by them, last
  Pace::Time measured_at_{};
  bool shows_gutter_ = false;
  std::optional<Demonstration> demonstration_;
  haptics::Tick newest_;
  FieldClarity clarity_;
  const std::function<haptics::LoopFigures()> servo_figures_ = [this] { return station().figures(); };
  const std::function<std::optional<std::string>()> recording_trouble_ = [this] {
    return equipment_.recordingTrouble();
  };
  const std::function<render::Image()> picture_ = [this] { return view_.shownPicture(); };
};

}  // namespace

int rehearse(RehearsalPlan plan) {
  interrupted = 0;
  installInterruptHandlers();
  plan.device_options.is_cancelled = [] { return interrupted != 0; };
  return Rehearsal(std::move(plan)).run();
}

bool wasInterrupted() { return interrupted != 0; }

}  // namespace app
