// What the surgeon's picture says (app/view/head_up_line): built from the newest tick and the command in force, with
// the line just said, the warnings, and the sheet of keys when it is open. Main thread, once a frame; some
// microseconds.
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>

#include "app/controls/control.h"
#include "app/rehearsal/warnings.h"
#include "app/view/head_up_line.h"

namespace app {

class HeadUp {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `with_laws`: the sheet of keys names those of the force laws.
  HeadUp(bool line_shown, bool with_laws) : line_shown_(line_shown), with_laws_(with_laws) {}

  /// Shown for two seconds from the next frame, a long line for the time that reading it takes.
  void say(const std::string& line) {
    said_ = {line, {}};
    last_said_ = line;
  }
  /// Also after it is gone from the picture.
  const std::string& lastSaid() const { return last_said_; }
  /// Executes the controls of the picture's text: line and keys. False: another control.
  bool execute(const ControlRequest& request);
  /// True if the sheet of keys was open: Esc closes it and does nothing else.
  bool closeKeys() { return std::exchange(keys_shown_, false); }

  struct Values {
    Situation situation;
    std::optional<double> gap_mm;
    std::string task;           ///< of a procedure
    std::string ruler;          ///< rulerText()
    bool pieces_ready = false;  ///< for forceps and elevators
    std::string socket;         ///< SocketFollower::line()
    std::string way = {};       ///< WayFollower::line()
    HeadUpRing ring = {};
    std::vector<HeadUpClearance> clearances = {};
    bool hints = false;     ///< says how to begin: to who works, not to who looks at it later
    std::string file = {};  ///< CanalLog::line()
    std::optional<HeadUpLocator> locator = {};
  };
  HeadUpContent content(const Values& values, Time now);

  /// Every tick, for the times.
  void follow(std::span<const haptics::Tick> ticks, bool irrigating) {
    for (const haptics::Tick& tick : ticks) times_.add(tick, irrigating);
  }

  const Warnings& warnings() const { return warnings_; }
  const WorkTimes& times() const { return times_; }

 private:
  struct Said {
    std::string line;
    std::optional<Time> until;  ///< none: not shown yet
  };
  bool line_shown_, with_laws_, keys_shown_ = false;
  bool has_drilled_ = false;
  Said said_;
  std::string last_said_;
  Warnings warnings_;
  WorkTimes times_;
};

}  // namespace app
