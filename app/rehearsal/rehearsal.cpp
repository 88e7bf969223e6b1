#include "app/rehearsal/rehearsal.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "app/controls/command_desk.h"
#include "app/controls/control_script.h"
#include "app/controls/hand_input.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/fast_pace.h"
#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/interrupt.h"
#include "app/rehearsal/pace.h"
#include "app/rehearsal/rehearsal_outputs.h"
#include "app/rehearsal/run_monitor.h"
#include "app/rehearsal/status_board.h"

namespace app {
namespace {

double width_mm(const calibration::ScreenCorners& screen) {
  return glm::distance(screen.lower_left.mm, screen.lower_right.mm);
}

/// One rehearsal from the first frame on.
class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        equipment_(plan_),
        input_(restingTool()),
        desk_(plan_.command, plan_.other_tools, plan_.parameters, equipment_.damping_Ns_per_mm(), equipment_.rate_Hz()),
        script_(equipment_.asks(), desk_.tray(), equipment_.rate_Hz()),
        outputs_(plan_),
        picture_(plan_, desk_.inForce(), equipment_.secondHand(), equipment_.rate_Hz(),
                 [this](const std::string& line) {
                   journal_.tell({"display", line});
                 }),
        duration_s_(plan_.seconds ? plan_.seconds : equipment_.duration_s()),
        monitor_(duration_s_),
        frame_(openingFrame(plan_)) {
    if (plan_.recording) plan_.recording->calibration = plan_.calibration;
    equipment_.join(plan_, desk_.inForce());
    desk_.serve(station());
    pace_ = paceOf();
    picture_.follow(station().bone());
    board_.emplace(plan_, equipment_, picture_, monitor_, journal_);
  }

  /// However it ends: the force goes first, then windows.
  ~Rehearsal() { station().stop(); }
  Rehearsal(const Rehearsal&) = delete;
  Rehearsal& operator=(const Rehearsal&) = delete;

  int run() {
    for (const std::string& remark : plan_.remarks) journal_.say(remark);
    if (const auto beside = station().recordedBeside())
      journal_.say("recording into " + *beside + " until it is closed, then in the place of " + plan_.recording->path);
    double first_picture_s = 0.0;
    if (pace_->isWatched()) {
      picture_.show(frame_);
      first_picture_s = secondsSince(plan_.begun);
      // Before the hand is there.
      picture_.settle(frame_);
    }
    outputs_.takeFirst(picture_, frame_, plan_.patient.ct.solid);
    start();
    const Pace::Time looping_since = pace_->now();
    const std::uint64_t settled = picture_.pictures();
    std::optional<Ending> ending;
    while (takeInput(), !(ending = endingNow())) {
      // When a file was changed is the wall's time.
      if (pace_->isWatched()) desk_.lookAtFile(pace_->now());
      followProcedure();
      if (desk_.takeOtherTool() && pace_->isWatched()) picture_.showInstrument();
      pace_->toNextFrame();
      followServo();
      if (pace_->isWatched()) picture_.show(frame_);
      if (picture_.adaptQuality(newest_.drilling || newest_.depth_mm > 0.0)) noteQuality();
      board_->show(pace_->now(), moment());
      serveOperator();
    }
    const double loop_s = secondsSince(looping_since);
    RehearsalFigures figures = finish(*ending);
    figures.first_picture_s = first_picture_s;
    figures.frame_ms = 1000.0 * loop_s / static_cast<double>(std::max<std::uint64_t>(1, figures.frames - settled));
    std::fputs(summaryText(figures).c_str(), plan_.procedure ? stderr : stdout);
    return answerOf(figures);
  }

 private:
  std::unique_ptr<Pace> paceOf() {
    if (plan_.ticking == Ticking::by_itself) return std::make_unique<RealPace>(picture_);
    return std::make_unique<FastPace>(station(), equipment_.secondHand(), script_, equipment_.rate_Hz(), duration_s_);
  }

  Workstation& station() { return equipment_.workstation(); }
  double secondsSince(Pace::Time start) const { return std::chrono::duration<double>(pace_->now() - start).count(); }

  void start() {
    equipment_.start();
    for (const std::string& remark : plan_.remarks) station().note("calibration", remark);
    journal_.keepIn(station());
    noteQuality();
  }

  std::optional<Ending> endingNow() {
    return monitor_.ending(newest_, pace_->now(), isInterrupted(), plan_.procedure && plan_.procedure->isOver(),
                           !station().isInForce(newest_));
  }

  void takeInput() {
    if (const render::Window* const window = picture_.window()) {
      const double mm_per_px = width_mm(plan_.rig.screen) / std::max(1, window->framebufferSize_px().x);
      for (const render::WindowEvent& event : picture_.display().takeEvents())
        if (!isForProcedure(event)) input_.take(event, mm_per_px);
    }
    if (haptics::MouseDevice* const mouse = equipment_.mouse())
      mouse->setTarget({{input_.X_WT().rotation, input_.X_WT().translation_mm}, input_.pedal()});
    obeyScript();
    for (const ControlWish& wish : equipment_.takeWishes()) obey(wish);
    for (const ControlWish& wish : input_.takeWishes()) obey(wish);
  }

  /// What is due at the tick that comes next; after the last one, what was due until then.
  void obeyScript() {
    const std::uint64_t made = newest_.dt_s > 0.0 ? newest_.index + 1 : 0;
    const std::uint64_t due = made > 0 && monitor_.isTimeOver(newest_) ? made - 1 : made;
    for (const ScriptedWish& scripted : script_.takeDue(due)) obey(scripted.wish, scripted.where);
  }

  /// `where`: it is written, if it is.
  void obey(const ControlWish& wish, const std::string& where = {}) {
    if (wish.control == Control::stop) return stopForGood();
    if (wish.control == Control::end) return monitor_.endByUser();
    if ((plan_.procedure && plan_.procedure->take(wish)) || desk_.obey(wish, where)) return;
    frame_.layers = layersAfter(frame_.layers, wish);
    if (wish.control == Control::snapshot) takeSnapshot(picture_, frame_, pace_->isWatched(), journal_);
    if (wish.control == Control::home) station().setHome();
  }

  void stopForGood() {
    station().emergencyStop();
    journal_.note("emergency stop", "motors off for good");
    journal_.say("emergency stop: the motors are off; end and start again to feel");
  }

  bool isForProcedure(const render::WindowEvent& event) const {
    const auto* key = std::get_if<render::KeyPressed>(&event);
    if (!plan_.procedure || !key || !key->down || key->repeated) return false;
    const int code = static_cast<int>(key->key);
    return code > ' ' && code <= 'Z' && plan_.procedure->takeKey(static_cast<char>(code));
  }

  void followProcedure() {
    if (!plan_.procedure) return;
    const std::vector<haptics::Tick> ticks = station().takeTicks();
    if (ticks.empty()) return;
    if (const auto wanted = plan_.procedure->follow(ticks)) desk_.follow(*wanted);
  }

  /// The tick first, then the bricks: what that tick cut is in this very frame.
  void followServo() {
    newest_ = station().newestTick();
    frame_ = nextFrame(frame_, newest_, desk_.inForce());
    if (equipment_.secondHand()) equipment_.secondHand()->place(frame_);
    if (pace_->isWatched()) picture_.bringBone();
  }

  void noteQuality() { journal_.note("quality", picture_.qualityText()); }

  StatusBoard::Moment moment() const { return {newest_, desk_.inForce(), frame_.layers}; }

  void serveOperator() {
    const OperatorSeat::Heard heard = board_->serveOperator(moment());
    for (const render::WindowEvent& event : heard.keys)
      if (!isForProcedure(event)) input_.take(event, 0.0);
    for (const ControlWish& wish : heard.wishes) obey(wish);
  }

  RehearsalFigures finish(Ending ending) {
    if (ending == Ending::silent)
      journal_.tell(
          {"device", "the device has not ticked for 10 s, so the rehearsal ends; check its cable and driver"});
    const MotionToPhoton& latency = picture_.latency();
    if (latency.pictures() > 0) journal_.note("latency", "median " + photonText(latency.median()));
    journal_.note("end", textOf(ending));
    journal_.note("servo", punctualityText(station().figures()));
    journal_.note("safety", "trips: " + tripsText(station().trips()));
    const RecordingSummary recorded = station().stop();
    // One more picture of what the bone has become.
    followServo();
    outputs_.takeLast(picture_, closingFrame(frame_, newest_, equipment_.mouse() != nullptr),
                      station().bone().solidInGridOrder());
    RehearsalFigures figures;
    figures.ticking = plan_.ticking;
    figures.last = board_->status(moment());
    figures.last.trips = station().trips();
    figures.removed_mm3 = station().bone().removedByTissue_mm3();
    picture_.describe(figures);
    if (plan_.recording) figures.recording = recorded;
    return figures;
  }

  RehearsalPlan plan_;
  Journal journal_;
  Equipment equipment_;
  HandInput input_;
  CommandDesk desk_;
  ControlScript script_;
  RehearsalOutputs outputs_;
  LivePicture picture_;
  std::unique_ptr<Pace> pace_;
  std::optional<double> duration_s_;
  RunMonitor monitor_;
  std::optional<StatusBoard> board_;  // goes before the picture
  render::Frame frame_;
  haptics::Tick newest_;
};

}  // namespace

int rehearse(RehearsalPlan plan) {
  obeyInterrupts();
  plan.device_options.given_up = [] { return isInterrupted(); };
  return Rehearsal(std::move(plan)).run();
}

}  // namespace app
