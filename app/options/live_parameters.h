// A settings file applied while the rehearsal runs: polled four times a second, read again when it changed. A valid
// file becomes the new command; an invalid one changes nothing and is reported once, in one line. Frame loop; a poll is
// one stat(2), reading takes under a millisecond.
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

  /// `base`: values of keys that the file leaves out. `check` throws UsageError for a command that must not be applied.
  LiveParameters(std::string path, const haptics::Command& base, Check check);

  /// At the start. Throws LoadError or UsageError.
  haptics::Command first();

  struct Reading {
    std::optional<haptics::Command> command;  ///< to apply
    std::string error;                        ///< or one line to report
  };
  /// None while the file is unchanged.
  std::optional<Reading> poll(Clock::time_point now);

 private:
  /// Differs after every change of the file.
  struct Version {
    std::int64_t s = 0, ns = 0, bytes = -1;
    std::uint64_t file = 0;
    bool operator==(const Version&) const = default;
  };
  Version currentVersion() const;
  haptics::Command read() const;

  std::string path_;
  haptics::Command base_;
  Check check_;
  Version read_version_;
  Clock::time_point polled_;
};

}  // namespace app
