// Writes a session file: SQLite in WAL mode, this object its only user. Each write() is one transaction, on disk for
// every process that opens the file later, whatever becomes of this one; after a power cut the last checkpoint stands.
// Where the file lies until it has its name: recording_place. One thread, never the servo; 0.2 ms per write of 50
// ticks, now and then 50 ms while the log is folded into the file. Not the queue in front of it (recorder.h).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/session/session_start.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/servo/tick.h"

namespace app {

struct SessionEvent {
  std::uint64_t tick = 0;
  std::string kind, text;
};

struct SessionCommand {
  haptics::Command command;
  std::uint64_t first_tick = 0;  ///< from which it is in force
};

/// What is written together.
struct SessionBatch {
  std::vector<SessionCommand> commands;
  std::vector<haptics::Tick> ticks;
  std::vector<SessionEvent> events;
};

class SessionWriter {
 public:
  /// Writes the start. Throws SessionError if the file exists and not `overwrite`, is being recorded, or can not be
  /// written.
  SessionWriter(const std::string& path, bool overwrite, const SessionStart& start);
  /// Without seal() the file stays as a killed program leaves it: valid to its last write; without ticks, none.
  ~SessionWriter();

  /// All of the batch or, with SessionError, nothing of it.
  void write(const SessionBatch& batch);

  /// Keeps the bone that is left, says how many ticks were written and lost, and leaves one single, closed file that
  /// is on the disk. Last call. `bone` may be null: it is not kept. Cost: of the bone.
  void seal(std::uint64_t lost, const haptics::CarvedBone* bone = nullptr);

  std::uint64_t ticks() const;
  /// The file as it is called now, and whether it takes the place of another once it is closed.
  const std::string& file() const;
  bool replaces() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
