// Writes a session file: SQLite in WAL mode, this object its only user. Each write() is one transaction, on disk for
// every process that opens the file later, whatever becomes of this one; after a power cut the last checkpoint stands.
// One thread, never the servo; 0.2 ms per write of 50 ticks, now and then 50 ms while the log is folded into the file.
// Not the queue in front of it (recorder.h).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/session/session_start.h"
#include "haptics/servo/tick.h"

namespace app {

struct SessionEvent {
  std::uint64_t tick = 0;
  std::string kind, text;
};

struct SessionPicture {
  std::uint64_t tick = 0;
  std::string name;  ///< with the extension of its format
  std::vector<std::uint8_t> bytes;
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
  std::vector<SessionPicture> pictures;
};

class SessionWriter {
 public:
  /// Creates the file with its start. Throws SessionError if it exists and not `overwrite`, or can not be written.
  SessionWriter(const std::string& path, bool overwrite, const SessionStart& start);
  /// Without seal() the file stays as a killed program leaves it: valid to its last write.
  ~SessionWriter();

  /// All of the batch or, with SessionError, nothing of it.
  void write(const SessionBatch& batch);

  /// Says how many ticks were written and lost, and leaves one single, closed file. Last call.
  void seal(std::uint64_t lost);

  std::uint64_t ticks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
