// Records a rehearsal: moves the servo's tick log and a queue of commands and events into a session file every
// kBetweenWrites, on a thread of its own or by drain(). A kill loses the time since the last write. Recording never
// stops the rehearsal: when the file cannot be written or memory is out, recording ends, the file is valid to its last
// write, and trouble() has one line. Ticks that did not fit into the log count as lost. Calls: any thread but the
// servo, microseconds; the constructor writes the bone (0.1 s), stop() closes the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/session/session_start.h"
#include "app/session/tick_tap.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick_log.h"

namespace app {

struct RecordingSummary {
  std::uint64_t ticks = 0;             ///< in the file
  std::uint64_t lost = 0;              ///< by the servo, not in the file
  std::optional<std::string> trouble;  ///< one line, if recording ended early
  std::string file = {};               ///< its current name, not the requested one if replacing another file failed

  /// Nothing is missing.
  bool isWhole() const { return lost == 0 && !trouble; }
};

inline constexpr std::chrono::milliseconds kBetweenWrites{20};

enum class DrainMode { by_thread, by_hand };

class Recorder {
 public:
  /// Throws SessionError if the file exists and not `overwrite`, or cannot be created. Borrows the log and is its only
  /// reader; construct before the servo's first tick. `tap`: borrowed; null: nobody else is told of the ticks.
  Recorder(const std::string& path, bool overwrite, const SessionStart& start, haptics::TickLog& log,
           DrainMode drain_mode = DrainMode::by_thread, TickTap* tap = nullptr);
  /// Stops, if stop() was not called.
  ~Recorder();

  /// The temporary name of the file until it replaces another at the close; none: there is nothing to replace.
  const std::optional<std::string>& temporaryFile() const;
  /// Its name until the first ticks are in it. From now on it holds the start, which does not change any more.
  const std::string& firstFile() const;

  /// Call before the command is published to the servo.
  void command(const haptics::Command& command) noexcept;
  /// `tick`: the newest one; none: the first of those that are written next.
  void event(const std::string& kind, const std::string& text, std::optional<std::uint64_t> tick = {}) noexcept;

  /// Writes what is new; for DrainMode::by_hand.
  void drain() noexcept;

  /// One line, if recording has ended early.
  std::optional<std::string> trouble() const;

  /// After the servo's last tick: writes the rest and the final bone (null: not stored), seals and closes the file.
  /// Repeated calls return the same summary.
  RecordingSummary stop(const haptics::Bodies* final_bodies = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
