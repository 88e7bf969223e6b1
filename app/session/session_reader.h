// Reads a session file, closed or left by a killed program, and changes no byte of it, of its log or of its folder.
// Never trusts the file: whatever its bytes, a call answers or throws SessionError (one line). Frame P. One thread; not
// the servo. Ticks are streamed block by block, so an hour of rehearsal needs no more memory than its bone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session_error.h"
#include "app/session/session_text.h"
#include "app/session/session_writer.h"

namespace app {

/// Up to 50 ticks.
struct TickBlock {
  std::vector<haptics::Tick> ticks;            ///< empty: there are no more; their removed_total_mm3 is not stored
  std::optional<RemovedByTissue> removed_mm3;  ///< since the start, after the last of them; none: schema 3 or 4
};

/// The refusal of a killed recording for which its second file is needed, and is not there.
SessionError missingLogError(const std::string& path, const std::string& log);

class SessionReader {
 public:
  /// Throws SessionError if the file is missing, no plain file, being recorded, or no session that is known here.
  explicit SessionReader(const std::string& path);
  ~SessionReader();

  /// One line on the first stored byte found changed: chain over all rows, then the seal over the file. Reads it all.
  std::optional<std::string> damage();

  /// Whether the recording was ended by the program, not by a kill or a full disk.
  bool closed() const;
  /// Closed, but its seal is missing or cut short, as a power cut leaves it: checked row by row alone.
  bool isUnsealed() const;
  /// A killed recording is two files: the name of the second, where it is not there.
  std::optional<std::string> missingLog() const;
  /// Ticks that were made and are not in it: as its seal says, or gaps in the numbers of the ticks read so far.
  std::uint64_t lost() const;

  /// The start without its voxels, which cost most.
  StoredStart about();
  StoredStart start();
  std::vector<SessionCommand> commands();
  std::vector<SessionEvent> events();
  /// The next block of ticks in recorded order.
  TickBlock nextBlock();
  /// Before the first of them again.
  void rewind();

  struct FinalBone {
    std::vector<std::uint8_t> solid;  ///< in the order of the grid
    std::uint64_t digest = 0;         ///< haptics::CarvedBone::digest()
  };
  /// The bone at the close; none: killed, or schema 3 or 4. `start` is this session's.
  std::optional<FinalBone> finalBone(const StoredStart& start);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
