// Who leads a rehearsal instead of its plan: sees every tick, may say what is to be felt, takes keys and controls
// before anybody else obeys them, stop and end aside, which are always obeyed; speaks to surgeon and instructor, knows
// when it is over. For experiments (psychophysics/trial_desk) and for operations step by step. Main thread, once a
// frame.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/controls/control.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// One line each; empty: nothing to say. The surgeon reads it in the window's title, unless the safety layer has to say
/// something; the instructor in the instructor's window, where there is one (--instructor).
struct ProcedureMessages {
  std::string to_surgeon, to_instructor;
  bool operator==(const ProcedureMessages&) const = default;
};

class Procedure {
 public:
  virtual ~Procedure() = default;
  /// A key as its upper-case letter, in either window. True: it was the procedure's, nobody else gets it.
  virtual bool takeKey(char /*key*/) { return false; }
  /// Neither stop nor end. True: nobody else obeys. By itself a procedure keeps what is felt.
  virtual bool take(const ControlRequest& request) { return meaningOf(request.control).is_felt; }
  /// Every tick since the last call, each once, oldest first, at least one. What is to be felt from now on, under a
  /// higher command_serial than that of the newest of them; none: as it is.
  virtual std::optional<haptics::Command> follow(std::span<const haptics::Tick> ticks) = 0;
  virtual ProcedureMessages words() const = 0;
  virtual bool isOver() const = 0;
};

}  // namespace app
