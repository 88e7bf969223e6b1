// A procedure leads a rehearsal: it receives every tick, may replace the command, handles keys and requests first
// (except stop and end, which are always executed), sends messages to surgeon and instructor, and decides when it is
// over. For experiments (psychophysics/trial_runner) and stepwise operations. Main thread, once a frame.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/controls/control.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// One line each; empty: none. The surgeon's is shown in the picture; the
/// instructor's in the instructor's window.
struct ProcedureMessages {
  std::string to_surgeon, to_instructor;
  bool operator==(const ProcedureMessages&) const = default;
};

class Procedure {
 public:
  virtual ~Procedure() = default;
  /// A key as its upper-case letter, from either window. True: handled, nothing else receives it.
  virtual bool takeKey(char /*key*/) { return false; }
  /// Any request but stop and end. True: handled. By default all requests that change what is felt.
  virtual bool take(const ControlRequest& request) { return meaningOf(request.control).is_felt; }
  /// Every tick since the last call, each once, oldest first, at least one. Returns the new command, with a
  /// command_serial above that of the newest tick, or none.
  virtual std::optional<haptics::Command> follow(std::span<const haptics::Tick> ticks) = 0;
  virtual ProcedureMessages messages() const = 0;
  virtual bool isOver() const = 0;
};

}  // namespace app
