// A stepped procedure during a rehearsal: gathers the facts that its steps ask for (step_tracker, gutter_watch), and
// makes of its news events of the recording and lines for the surgeon. Main thread, once a frame; microseconds, once a
// second a few more.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/procedure/gutter_watch.h"
#include "app/procedure/steps/step_tracker.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/session/socket_event.h"
#include "app/session/touch_event.h"

namespace app {

class StepFollower {
 public:
  /// `plan` has steps. Borrows all.
  StepFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log);

  /// To the recording: which procedure it is, and a prediction from the command line. Before the first tick.
  void start();
  /// The surgeon's, at that time; nothing said is no prediction.
  void predict(const std::string& difficulty, std::optional<double> minutes, double t_s);
  /// All ticks, in order, made with this command. `bridge_mm`: the thinnest bridge that holds the tooth. `socket`: once
  /// a piece is out. `flap`: where the gum was closed.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::optional<double> bridge_mm,
              const std::optional<SocketRecord>& socket, const std::optional<FlapFacts>& flap = {});
  /// A touch that ended.
  void follow(const Touch& touch);
  /// Bricks of the jaw's grid that have changed.
  void followBone(std::span<const glm::ivec3> bricks, double t_s, bool waits);
  /// By key: on to the next step.
  std::string skip();
  void finish();

  /// "4/10 Bare the crown: crown bared 34 of 70 %"; empty unless guided.
  std::string task() const;
  /// A line when a step begins; none unless guided.
  std::optional<std::string> news();
  /// In the newest tick, where the step in hand counts that as an error.
  bool usesOtherInstrument() const { return tracker_.usesOtherInstrument(); }
  /// The planned gutter is to be seen: it is the region of the step in hand.
  bool showsGutter() const;
  ProcedureRun run() const;
  const Prediction& prediction() const { return prediction_; }

 private:
  void tell();

  const RehearsalPlan& plan_;
  EventLog& event_log_;
  StepTracker tracker_;
  std::optional<GutterWatch> gutter_;
  Prediction prediction_;
  std::string operated_;
  std::optional<std::size_t> told_;
  std::deque<std::string> news_;
};

}  // namespace app
