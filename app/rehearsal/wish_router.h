// Everybody in the room may ask for something: the hand at mouse and keys, the device's buttons, the pedal, a script,
// the operator. Each wish goes to the one who obeys it: stop and end at once, then the procedure, the command in force,
// the layers of the picture. Main thread, once a frame; microseconds, a snapshot as long as its file takes.
#pragma once

#include <string>

#include "app/controls/command_desk.h"
#include "app/controls/control_script.h"
#include "app/controls/hand_input.h"
#include "app/instructor/operator_seat.h"
#include "app/rehearsal/equipment.h"
#include "app/rehearsal/journal.h"
#include "app/rehearsal/live_picture.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/run_monitor.h"

namespace app {

class WishRouter {
 public:
  /// Borrows them all. Throws UsageError that names the row of a script that asks for what there is not.
  WishRouter(const RehearsalPlan& plan, Equipment& equipment, CommandDesk& desk, RunMonitor& monitor,
             LivePicture& picture, Journal& journal);

  const ControlScript& script() const { return script_; }

  /// What was asked for since the last call, but by the operator; a mouse that is the hand is moved. `newest` has a dt
  /// of 0 before the first tick. Layers are switched in `frame`, of which a snapshot is taken.
  void takeInput(const haptics::Tick& newest, render::Frame& frame);
  void takeFromOperator(const OperatorSeat::Heard& heard, render::Frame& frame);

 private:
  void takeFromWindow();
  void obeyScript(const haptics::Tick& newest, render::Frame& frame);
  void obey(const ControlWish& wish, render::Frame& frame, const std::string& where = {});
  void stopForGood();
  bool isForProcedure(const render::WindowEvent& event) const;

  const RehearsalPlan& plan_;
  Equipment& equipment_;
  CommandDesk& desk_;
  RunMonitor& monitor_;
  LivePicture& picture_;
  Journal& journal_;
  HandInput input_;
  ControlScript script_;
};

}  // namespace app
