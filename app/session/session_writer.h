// Writes a session file: SQLite in WAL mode, with this object as its only user. Each write() is one transaction,
// visible to every process that opens the file later, also after a kill; after a power cut the last checkpoint remains.
// One thread, never the servo; 0.2 ms per write of 50 ticks, occasionally 50 ms for a checkpoint. Temporary name and
// lock: recording_file.h; queue: recorder.h.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/session/session_start.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// Kind of the events of the ruler.
inline constexpr char kRulerEvent[] = "ruler";

struct SessionEvent {
  std::uint64_t tick = 0;
  std::string kind, text;
};

struct SessionCommand {
  haptics::Command command;
  std::uint64_t first_tick = 0;  ///< the first tick with this command
};

/// Written in one transaction.
struct SessionBatch {
  std::vector<SessionCommand> commands;
  std::vector<haptics::Tick> ticks;
  std::vector<SessionEvent> events;
};

class SessionWriter {
 public:
  /// Writes the start. Throws SessionError if the file exists and not `overwrite`, is being recorded or cannot be
  /// written.
  SessionWriter(const std::string& path, bool overwrite, const SessionStart& start);
  /// Without seal() the file is valid to its last write, as after a kill; without ticks it is removed.
  ~SessionWriter();

  /// Writes all of the batch or throws SessionError.
  void write(const SessionBatch& batch);

  /// Stores the final bone (null: not stored) and the numbers of ticks written and lost, and leaves one closed file,
  /// synced to the disk. The last call; takes as long as storing the bone.
  void seal(std::uint64_t lost, const haptics::Bodies* bodies = nullptr);

  std::uint64_t ticks() const;
  /// The current file name, and whether the file replaces another when it is closed.
  const std::string& file() const;
  bool replaces() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
