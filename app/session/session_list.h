// The sessions of a folder as values, newest first: for `molar sessions` and the start screen. Reads the start and the
// end of each file, not its ticks: 2 ms a session. A file that cannot be read is listed with its reason. Any thread but
// the servo.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace app {

enum class SessionVerdict : std::uint8_t {
  complete,   ///< closed in order, no tick lost
  gaps,       ///< closed in order, but ticks were lost
  killed,     ///< the program or the disk ended it: complete up to then
  recording,  ///< another program is recording to it
  damaged,    ///< cannot be read
};
/// "complete", "gaps", …
const char* nameOf(SessionVerdict verdict);

struct SessionListing {
  std::string path;
  std::int64_t unix_s = 0;  ///< when it started; for old files when it was written last
  std::string case_title;   ///< empty: not readable
  double length_s = 0.0;
  std::uint64_t bytes = 0;  ///< with its log
  SessionVerdict verdict = SessionVerdict::damaged;
  std::string remark;                    ///< why, for people; empty: nothing to say
  std::optional<std::string> continues;  ///< file name of the session it continues
  bool is_imported = false;              ///< of a patient folder, which it does not name

  bool isReadable() const { return verdict != SessionVerdict::damaged && verdict != SessionVerdict::recording; }
};

/// `checks`: reads every byte and finds any changed one; as slow as the disk. `at_most`: of those written last. A
/// folder that does not exist is empty.
std::vector<SessionListing> listSessions(const std::filesystem::path& folder, bool checks = false,
                                         std::size_t at_most = static_cast<std::size_t>(-1));

}  // namespace app
