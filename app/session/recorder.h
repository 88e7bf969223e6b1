// Records a rehearsal: drains the servo's tick log and a queue of commands and events into a session file, on a thread
// of its own every kBetweenWrites, so that a kill loses no more than came since, and what a write takes; or when its
// owner says so, where the ticks themselves are made by hand. Never stops the rehearsal: when the file can not be
// written any more or memory is out, recording ends, the file stays valid to its last write, and trouble() says so. The
// servo knows nothing of this; ticks it could not log are counted as lost. Calls: any thread but the servo,
// microseconds; the constructor writes the bone (0.1 s), stop() closes the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/session/session_start.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/servo/tick_log.h"

namespace app {

struct RecordingSummary {
  std::uint64_t ticks = 0;             ///< in the file
  std::uint64_t lost = 0;              ///< made by the servo, not in the file
  std::optional<std::string> trouble;  ///< one line, if recording ended early
  std::string file = {};               ///< as it is called now: where another was to be replaced, not always its name

  /// Everything that happened is in the file.
  bool isWhole() const { return lost == 0 && !trouble; }
};

inline constexpr std::chrono::milliseconds kBetweenWrites{20};

enum class DrainMode { by_thread, by_hand };

class Recorder {
 public:
  /// Throws SessionError if the file exists and not `overwrite`, or can not be created. Borrows the log, of which this
  /// becomes the one reader; construct it before the servo's first tick.
  Recorder(const std::string& path, bool overwrite, const SessionStart& start, haptics::TickLog& log,
           DrainMode drain_mode = DrainMode::by_thread);
  /// Stops, if stop() was not called.
  ~Recorder();

  /// The file that is written until the close, where another bears the name until then; none: it soon has its name.
  const std::optional<std::string>& temporaryFile() const;

  /// To be called before the command is published to the servo.
  void command(const haptics::Command& command) noexcept;
  void event(const std::string& kind, const std::string& text) noexcept;

  /// Writes what has come since the last time; for a recorder that is drained by hand.
  void drain() noexcept;

  /// One line, once recording has ended early.
  std::optional<std::string> trouble() const;

  /// After the servo's last tick: writes what is left and the bone that is left (null: it is not kept), seals and
  /// closes the file. Again: the same answer.
  RecordingSummary stop(const haptics::CarvedBone* final_bone = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
