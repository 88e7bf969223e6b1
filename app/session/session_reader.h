// Reads a session file, closed or left by a killed program, without changing the file, its log or its folder. The file
// is untrusted: whatever its bytes, a call returns a result or throws SessionError (one line). Frame P. One thread, not
// the servo. Ticks are streamed in blocks, so memory use is that of the bone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session_error.h"
#include "app/session/session_text.h"
#include "app/session/session_writer.h"
#include "haptics/bone/filling.h"

namespace app {

/// Up to 50 ticks.
struct TickBlock {
  std::vector<haptics::Tick> ticks;            ///< empty: the end; removed_total_mm3 is not set
  std::optional<RemovedByTissue> removed_mm3;  ///< total after the last of them; none: schema 3 or 4
};

/// For a killed recording whose log is missing.
SessionError missingLogError(const std::string& path, const std::string& log);

class SessionReader {
 public:
  /// Throws SessionError if the file is missing, not regular, being recorded, or not a known session.
  explicit SessionReader(const std::string& path);
  ~SessionReader();

  /// The start of a session while another program records it, also of one that is closed: what the file holds of it
  /// does not change. Throws SessionError.
  static StoredStart startWhileRecorded(const std::string& path);

  /// One line on the first change found: chain over all rows, then the seal over the file. Reads it all.
  std::optional<std::string> damage();

  /// False: the recording ended by a kill or a full disk.
  bool closed() const;
  /// Closed, but its seal is missing or incomplete, as after a power cut: only the rows can be checked.
  bool isUnsealed() const;
  /// The name of the log, if the recording was killed and its log is missing.
  std::optional<std::string> missingLog() const;
  /// Length by the last block alone, lost ticks included; cheap. 0: no tick.
  double length_s();
  /// Ticks that are not in the file: by its seal, or gaps in the indices read so far.
  std::uint64_t lost() const;

  /// The start without its voxels; cheap.
  StoredStart about();
  StoredStart start();
  std::vector<SessionCommand> commands();
  std::vector<SessionEvent> events();
  /// The next block of ticks in recorded order.
  TickBlock nextBlock();
  /// Back to the first block.
  void rewind();
  /// Between two blocks of this reader, plain values.
  struct BlockPlace {
    std::int64_t after_row = -1;  ///< the last one read
    std::uint64_t next_index = 0, gaps = 0;
  };
  BlockPlace place() const;
  /// The next block is that after the place; some microseconds.
  void continueAt(const BlockPlace& place);

  struct FinalBone {
    std::vector<std::uint8_t> solid;  ///< in the order of the grid
    std::uint64_t digest = 0;         ///< haptics::Bodies::digest()
  };
  /// The bone at the close; none: killed, or schema 3 or 4. `start` is that of this session.
  std::optional<FinalBone> finalBone(const StoredStart& start);
  /// What lies in the tooth at the end; none: nothing does, or the session was not ended in order.
  std::optional<haptics::Filling::Volumes> finalFilling(const StoredStart& start);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
