// What a participant takes back, and what has outlived its time. A withdrawn stream loses its sealed key and its files;
// rows stay without words, the recording stays as it is. Where words stand open in a log (a study without keys) the log
// is written anew without them, and the audit names both ends of its chain. Retention removes whole sessions. Main
// thread; as slow as the disk.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace app {

inline constexpr std::array<std::string_view, 5> kWithdrawnStreams{"audio", "words", "answers", "picture", "all"};

/// In one session's folder.
struct Removal {
  std::string session;             ///< "P07-1"
  std::vector<std::string> files;  ///< in the folder, to be unlinked; a folder ends with '/'
  bool rewrites_log = false;       ///< words stand open in it

  bool isNothing() const { return files.empty() && !rewrites_log; }
};

/// All visits and attempts of the participant that hold something of the stream. Throws LoadError: no such study;
/// UsageError: this participant is not in it.
std::vector<Removal> withdrawalOf(const std::string& study, const std::string& participant, std::string_view stream);
/// Audits it, then does it. Throws CalibrationError where the disk refuses.
void withdraw(const std::string& study, const std::string& participant, std::string_view stream,
              const std::vector<Removal>& removals, std::int64_t now_s);

/// A session whose days are over.
struct Expired {
  std::string session;
  std::string stopped_utc;
  std::int64_t days = 0;  ///< it was to be kept
};
/// By session.stop's time, or the newest that is known of it. Throws UsageError: the clock went back.
std::vector<Expired> expiredSessions(const std::string& study, std::int64_t now_s);
/// Audits each, then removes its folder, keys first.
void removeExpired(const std::string& study, const std::vector<Expired>& expired, std::int64_t now_s);

}  // namespace app
