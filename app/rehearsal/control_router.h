// Routes control requests (control.h) from mouse, keys, device buttons, pedal, script and instructor. Stop and end are
// executed at once (Esc of the surgeon asks first, Esc of the instructor never ends); the others go to the procedure
// first, then to the command in force, then to layers, snapshot and homing. Main thread, once a frame; microseconds,
// for a snapshot the time of writing its file.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/controls/active_command.h"
#include "app/controls/control_script.h"
#include "app/controls/end_question.h"
#include "app/controls/hand_input.h"
#include "app/controls/held_press.h"
#include "app/controls/other_hand_input.h"
#include "app/controls/prediction_question.h"
#include "app/controls/tool_ring.h"
#include "app/instructor/instructor_window.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/head_up.h"
#include "app/rehearsal/live_view.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/run_monitor.h"
#include "app/view/desk_view.h"

namespace app {

class ControlRouter {
 public:
  /// Borrows all. Throws UsageError naming the row of a script whose request is not possible.
  ControlRouter(const RehearsalPlan& plan, Equipment& equipment, ActiveCommand& active_command, RunMonitor& monitor,
                LiveView& view, HeadUp& head_up, EventLog& event_log);

  const ControlScript& script() const { return script_; }
  /// To the surgeon, instead of anything else; empty: none.
  std::string question() const {
    return end_question_.isOpen() ? EndQuestion::kText : prediction_.isOpen() ? prediction_.text() : std::string();
  }
  /// The surgeon's prediction, once, when it was asked for and said.
  std::optional<PredictionAnswer> takePrediction() { return prediction_.takeAnswer(); }
  /// How often the next step of the procedure was asked for since the last call.
  int takeSteps() { return std::exchange(steps_, 0); }
  /// Whether it was asked since the last call what keeps the tooth in.
  bool takeWay() { return std::exchange(asks_way_, false); }
  /// How often the jaws were to close on paper since the last call.
  int takeBites() { return std::exchange(bites_, 0); }
  /// Touches of the surgeon's own plan since the last call, in order; none in it: on to the next line.
  std::vector<std::optional<glm::dvec3>> takeDrawn() { return std::exchange(drawn_, {}); }
  /// The instruments to choose from, while they are shown.
  const ToolRing& ring() const { return ring_; }
  /// Sound that was asked for since the last call: on, off, or the other (kNoValue).
  std::optional<int> takeSound() { return std::exchange(sound_, {}); }
  /// Of the tool of a mouse, W.
  const glm::dvec3& handPosition_W_mm() const { return input_.X_WT().translation_mm; }
  /// Of a mouse, before it is started: the hand is there at once, and touches nothing on a way there.
  void placeHandAt(const glm::dvec3& position_W_mm);

  /// Executes all requests since the last call except the instructor's, and moves the mouse device. `newest` has a dt
  /// of 0 before the first tick. Layers are switched in `frame`, and snapshots are taken of it.
  void handleInput(const haptics::Tick& newest, render::Frame& frame);
  void handleInstructorInput(const InstructorWindow::Input& input, render::Frame& frame);

 private:
  bool isTakenByPrediction(const render::WindowEvent& event);
  bool isTakenByEndQuestion(const render::WindowEvent& event);
  void executeKeys(render::Frame& frame, bool may_choose_law);
  void readWindow(render::Frame& frame);
  bool scrollSlice(const render::WindowEvent& event, render::Frame& frame);
  void showDeskView(render::Frame& frame);
  void changeView(const ControlRequest& request, render::Frame& frame);
  void executeScript(const haptics::Tick& newest, render::Frame& frame);
  void execute(const ControlRequest& request, render::Frame& frame, const std::string& where = {});
  void stopMotors();
  void tellPaint(const ControlRequest& request, const render::Layers& layers);
  bool isHelpRefused(const ControlRequest& request);
  void takeSnapshot(const render::Frame& frame);
  glm::dvec3 touched_P_mm(render::Frame& frame);
  void markRuler(render::Frame& frame);
  void followToolButton(const haptics::Tick& newest, render::Frame& frame);
  void switchRing(bool open, const render::Frame& frame);
  bool isFileInTooth();
  void closeRing();
  glm::dvec2 handOnScreen(const render::Frame& frame);
  bool isTakenByProcedure(const render::WindowEvent& event) const;
  bool isTakenByRing(const render::WindowEvent& event, const render::Frame& frame);

  const RehearsalPlan& plan_;
  Equipment& equipment_;
  ActiveCommand& active_command_;
  RunMonitor& monitor_;
  LiveView& view_;
  HeadUp& head_up_;
  EventLog& event_log_;
  HandInput input_;
  std::optional<OtherHandInput> other_hand_;  ///< where a mouse moves it
  EndQuestion end_question_;
  PredictionQuestion prediction_;
  int steps_ = 0;
  int bites_ = 0;
  bool asks_way_ = false;
  std::vector<std::optional<glm::dvec3>> drawn_;
  ToolRing ring_;
  HeldPress tool_press_;
  std::optional<int> sound_;
  DeskView desk_view_;
  glm::dvec2 pointer_px_{0.0};
  ControlScript script_;
};

}  // namespace app
