// Everybody in the room may ask for something: the hand at mouse and keys, the device's buttons, the pedal, a script,
// the instructor. Each request goes to the one who obeys it: stop and end at once, then the procedure, the command in
// force, the layers of the picture. Main thread, once a frame; microseconds, a snapshot as long as its file takes.
#pragma once

#include <string>

#include "app/controls/active_command.h"
#include "app/controls/control_script.h"
#include "app/controls/hand_input.h"
#include "app/instructor/instructor_display.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/live_view.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/run_monitor.h"

namespace app {

class ControlRouter {
 public:
  /// Borrows them all. Throws UsageError that names the row of a script that asks for what there is not.
  ControlRouter(const RehearsalPlan& plan, Equipment& equipment, ActiveCommand& active_command, RunMonitor& monitor,
                LiveView& picture, EventLog& event_log);

  const ControlScript& script() const { return script_; }

  /// What was asked for since the last call, but by the instructor; a mouse that is the hand is moved. `newest` has a dt
  /// of 0 before the first tick. Layers are switched in `frame`, of which a snapshot is taken.
  void handleInput(const haptics::Tick& newest, render::Frame& frame);
  void handleInstructorInput(const InstructorDisplay::Input& input, render::Frame& frame);

 private:
  void readWindow();
  void executeScript(const haptics::Tick& newest, render::Frame& frame);
  void execute(const ControlRequest& request, render::Frame& frame, const std::string& where = {});
  void stopMotors();
  bool isTakenByProcedure(const render::WindowEvent& event) const;

  const RehearsalPlan& plan_;
  Equipment& equipment_;
  ActiveCommand& active_command_;
  RunMonitor& monitor_;
  LiveView& view_;
  EventLog& event_log_;
  HandInput input_;
  ControlScript script_;
};

}  // namespace app
