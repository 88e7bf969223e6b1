// A settings file that is obeyed while the rehearsal runs: looked at four times a second, read again when it changed.
// A file that can not be used changes nothing and is named once, in one line; one that can becomes the new command.
// Polled by the frame loop, never by the servo; a look is one stat(2), a reading under a millisecond.
// Not the recording of changes (Workstation::change) and not the log (changesBetween).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "haptics/servo/command.h"

namespace app {

class LiveParameters {
 public:
  using Clock = std::chrono::steady_clock;
  using Check = std::function<void(const haptics::Command&)>;

  /// `base` holds what the file leaves out; `check` throws UsageError for a command that must not be obeyed.
  LiveParameters(std::string path, const haptics::Command& base, Check check);

  /// The file as it is at the start; throws UsageError.
  haptics::Command first();

  struct Reading {
    std::optional<haptics::Command> command;  ///< obey this
    std::string trouble;                      ///< or say this line
  };
  /// None while there is nothing new.
  std::optional<Reading> look(Clock::time_point now);

 private:
  /// What a change of the file changes: time, size and which file it is.
  struct Mark {
    std::int64_t s = 0, ns = 0, bytes = -1;
    std::uint64_t file = 0;
    bool operator==(const Mark&) const = default;
  };
  Mark markOf() const;
  haptics::Command read() const;

  std::string path_;
  haptics::Command base_;
  Check check_;
  Mark seen_;
  Clock::time_point looked_;
};

}  // namespace app
