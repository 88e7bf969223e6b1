// The folder into which rehearsals are recorded unless told otherwise, and the names of the files in it: date, time and
// tooth, nothing of a person. Main thread; a few file-system calls, `last` one per session.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace app {

/// $XDG_DATA_HOME/molar/sessions or ~/.local/share/molar/sessions. Throws SessionError if neither is known.
std::filesystem::path usualSessionFolder();

/// A free name in the folder: "2026-11-24-154322-tooth-48.molar" for local time. `fdi` 0: no tooth.
std::string newSessionPath(const std::filesystem::path& folder, std::int64_t unix_s, int fdi);

/// Creates the folder if needed. Throws SessionError: no file can be written there.
void makeSessionFolder(const std::filesystem::path& folder);

/// The newest session of the usual folder for "last" (killed ones included, one that is being recorded not), any other
/// text unchanged. Throws SessionError if there is none.
std::string sessionNamed(const std::string& text);

/// Of an argument that names a session.
inline constexpr const char* kSessionHelp = "Session file, or last: the newest in the data folder";

/// When its file or its log was written last.
std::filesystem::file_time_type lastWritten(const std::filesystem::path& session);

}  // namespace app
