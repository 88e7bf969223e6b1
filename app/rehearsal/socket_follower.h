// The socket during a rehearsal, once a piece of the tooth is out (procedure/socket): what is left to do as a line for
// the surgeon, marks on sharp edges and on what is left, and events of the recording. Main thread, once a frame.
// Without a labelled tooth of its own it does nothing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/procedure/socket/socket_watch.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "render/frame.h"

namespace app {

class SocketFollower {
 public:
  /// Borrows all.
  SocketFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log);

  /// Once a frame. `bricks`: of the jaw's grid, changed since the last call. `waits`: for a servo that is stepped.
  void follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool waits);
  /// Looks once more, for the recording, before that is closed.
  void finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);

  /// "socket not clean: sharp edges 12 mm"; empty: no piece is out.
  std::string line() const;
  /// Where sharp edges and pieces are.
  const std::vector<render::Bead>& marks() const { return marks_; }
  /// None: no piece is out.
  const std::optional<SocketRecord>& newest() const { return told_; }

 private:
  void tell();

  EventLog& event_log_;
  std::optional<SocketWatch> watch_;
  std::optional<SocketRecord> told_;
  std::vector<render::Bead> marks_;
};

}  // namespace app
