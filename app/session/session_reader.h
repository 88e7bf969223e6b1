// Reads a session file, closed or left by a killed program, and changes no byte of it or of its log. A closed one is
// read without a trace; beside a killed one, FILE and FILE-wal, SQLite leaves its index FILE-shm, for which the folder
// must be writable: a read-only connection can not take the exclusive lock that would spare it.
// Never trusts the file: whatever its bytes, a call answers or throws SessionError (one line). Frame P. One thread; not
// the servo. Ticks are streamed block by block, so an hour of rehearsal needs no more memory than its bone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session_writer.h"

namespace app {

/// SessionStart as stored, owning its voxels.
struct StoredStart {
  std::string patient_title, program_version;
  double dt_s = 0.0;
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, label;
  std::optional<SessionCalibration> calibration;  ///< none: recorded before it was
};

class SessionReader {
 public:
  /// Throws SessionError if the file is missing or no session of this schema or the one before.
  explicit SessionReader(const std::string& path);
  ~SessionReader();

  /// One line on the first stored byte found changed: chain over all rows, then the seal over the file. Reads it all.
  std::optional<std::string> damage();

  /// Whether the recording was ended by the program, not by a kill or a full disk.
  bool closed() const;
  /// Ticks the recorder could not take; known only of a closed session.
  std::uint64_t lost() const;

  StoredStart start();
  std::vector<SessionCommand> commands();
  std::vector<SessionEvent> events();
  std::vector<SessionPicture> pictures();
  /// The next block of ticks in recorded order; empty at the end.
  std::vector<haptics::Tick> nextTicks();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
