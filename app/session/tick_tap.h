// Who receives what a recorder has taken from the servo's log, in the order of the ticks: each command with its first
// tick, then the ticks. On the recorder's thread, before it writes; every kBetweenWrites. Never blocks.
#pragma once

#include <span>

#include "app/session/session_writer.h"

namespace app {

class TickTap {
 public:
  virtual ~TickTap() = default;
  /// The first call has the command of the start, without ticks.
  virtual void take(std::span<const SessionCommand> commands, std::span<const haptics::Tick> ticks) noexcept = 0;
  /// The recording has ended early: no more come.
  virtual void end() noexcept = 0;
};

}  // namespace app
