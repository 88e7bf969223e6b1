#include "app/rehearsal/rehearsal.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "app/controls/command_desk.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/fast_pace.h"
#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/interrupt.h"
#include "app/rehearsal/pace.h"
#include "app/rehearsal/rehearsal_outputs.h"
#include "app/rehearsal/run_monitor.h"
#include "app/rehearsal/status_board.h"
#include "app/rehearsal/wish_router.h"
#include "app/text/said.h"

namespace app {
namespace {

/// One rehearsal from the first frame on.
class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        equipment_(plan_),
        desk_(plan_.command, plan_.other_tools, plan_.parameters, equipment_.damping_Ns_per_mm(), equipment_.rate_Hz()),
        duration_s_(plan_.seconds ? plan_.seconds : equipment_.duration_s()),
        monitor_(duration_s_),
        router_(plan_, equipment_, desk_, monitor_, picture_, journal_),
        picture_(plan_, desk_.inForce(), equipment_.secondHand(), equipment_.rate_Hz(),
                 [this](const std::string& line) {
                   journal_.tell({"display", line});
                 }),
        frame_(openingFrame(plan_)) {
    // Pictures with a name are claimed before the work.
    if (!plan_.snapshot.empty()) last_.emplace(plan_.snapshot, plan_.overwrite);
    if (!plan_.first_snapshot.empty()) first_.emplace(plan_.first_snapshot, plan_.overwrite);
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
    for (const std::string& remark : plan_.remarks) say(remark);
    if (const auto beside = station().recordedBeside())
      say("recording into " + *beside + " until it is closed, then in the place of " + plan_.recording->path);
    double first_picture_s = 0.0;
    if (pace_->isWatched()) {
      picture_.show(frame_);
      first_picture_s = secondsSince(plan_.begun);
      // Before the hand is there.
      picture_.settle(frame_);
    }
    if (first_) picture_.take(*first_, frame_, plan_.patient.ct.solid);
    start();
    const Pace::Time looping_since = pace_->now();
    const std::uint64_t settled = picture_.pictures();
    std::optional<Ending> ending;
    while (router_.takeInput(newest_, frame_), !(ending = endingNow())) {
      // When a file was changed is the wall's time.
      if (pace_->isWatched()) desk_.lookAtFile(pace_->now());
      followProcedure();
      if (desk_.takeOtherTool() && pace_->isWatched()) picture_.showInstrument();
      pace_->toNextFrame();
      followServo();
      if (pace_->isWatched()) picture_.show(frame_);
      if (picture_.adaptQuality(newest_.drilling || newest_.depth_mm > 0.0)) noteQuality();
      board_->show(pace_->now(), moment());
      router_.takeFromOperator(board_->serveOperator(moment()), frame_);
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
    return std::make_unique<FastPace>(station(), equipment_.secondHand(), router_.script(), equipment_.rate_Hz(),
                                      duration_s_);
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

  RehearsalFigures finish(Ending ending) {
    board_->tellEnd(ending);
    const RecordingSummary recorded = station().stop();
    // One more picture of what the bone has become.
    followServo();
    if (last_)
      picture_.take(*last_, closingFrame(frame_, newest_, equipment_.mouse() != nullptr),
                    station().bone().solidInGridOrder());
    RehearsalFigures figures = board_->figures(moment());
    if (plan_.recording) figures.recording = recorded;
    return figures;
  }

  RehearsalPlan plan_;
  Journal journal_;
  Equipment equipment_;
  CommandDesk desk_;
  std::optional<double> duration_s_;
  RunMonitor monitor_;
  WishRouter router_;
  std::optional<EyePictures> first_, last_;
  LivePicture picture_;
  std::unique_ptr<Pace> pace_;
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
