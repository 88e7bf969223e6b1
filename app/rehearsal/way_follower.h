// What keeps the tooth and its pieces in, told to the surgeon (procedure/way_watch): a line in the picture, the bone to
// take away, an event of the recording. An assessed rehearsal is told nothing. Main thread, once a frame. Without a
// tooth of its own it says nothing.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/procedure/way_watch.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/rehearsal_plan.h"

namespace app {

class WayFollower {
 public:
  /// Before the first tick. Borrows all.
  WayFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log);

  /// The surgeon wants to know now.
  void ask();
  /// `alone`: also when nobody asks; the others as WayWatch::follow().
  void follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool alone, bool waits);

  /// Why there is no answer.
  std::optional<std::string> news() { return std::exchange(news_, std::nullopt); }
  /// What was found last; empty: nothing, or no piece is left.
  std::string words() const;
  /// The same, or that it is being looked for.
  std::string line() const;
  render::Obstacles obstacles() const;

 private:
  EventLog& event_log_;
  std::string why_not_;  ///< empty: it looks
  std::optional<WayWatch> watch_;
  std::optional<std::string> news_;
};

}  // namespace app
