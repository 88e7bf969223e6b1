// A session's servo run again beside it, or from its recording: live bone and what the operation has left, tick by tick
// (session/rerun, session/measures/bone_measures). Frame P. One thread; a tick costs what the servo's did.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/measures/bone_measures.h"
#include "app/session/measures/session_case.h"
#include "app/session/rerun.h"
#include "app/session/session_start.h"
#include "haptics/body/bodies.h"

namespace app {

class Follower {
 public:
  /// `ids` of outcomeNames(); without any the case is not looked at. Takes some seconds.
  Follower(StoredStart start, std::vector<std::string> ids);
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// Before the tick that each is first in force in.
  void add(std::span<const SessionCommand> commands) { rerun_.add(commands); }
  /// The next tick, by its inputs. Returns why it is another than the session's: lost ticks, or a missing command.
  std::optional<std::string> step(const haptics::Tick& input);

  const haptics::Tick& tick() const { return tick_; }  ///< the last one
  const haptics::Command& command() const { return rerun_.command(); }
  const BoneMeasures& measures() const { return measures_; }
  const haptics::Bodies& bodies() const { return bodies_; }

 private:
  StoredStart start_;
  SessionCase about_;
  haptics::Bodies bodies_;
  Rerun rerun_;
  BoneMeasures measures_;
  haptics::Tick tick_;
};

}  // namespace app
