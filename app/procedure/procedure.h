// Who leads a rehearsal instead of its plan: sees the ticks, may say what is to be felt, takes keys and controls before
// anybody else obeys them, speaks to surgeon and instructor, knows when it is over. For experiments
// (psychophysics/trial_desk) and for operations step by step. Main thread, once a frame.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/controls/control.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// One line each; empty: nothing to say.
struct ProcedureWords {
  std::string to_surgeon, to_instructor;
  bool operator==(const ProcedureWords&) const = default;
};

class Procedure {
 public:
  virtual ~Procedure() = default;
  /// A key as its upper-case letter, in either window. True: it was the procedure's, nobody else gets it.
  virtual bool takeKey(char /*key*/) { return false; }
  /// True: nobody else obeys. By itself a procedure keeps what is felt.
  virtual bool take(const ControlWish& wish) { return meaningOf(wish.control).is_felt; }
  /// Ticks since the last call, oldest first: at least the newest, not always all. What is to be felt from now on;
  /// none: as it is.
  virtual std::optional<haptics::Command> follow(std::span<const haptics::Tick> ticks) = 0;
  virtual ProcedureWords words() const = 0;
  virtual bool isOver() const = 0;
};

}  // namespace app
