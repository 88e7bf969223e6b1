// The folder into which rehearsals are recorded unless told otherwise, and the names of the sessions in it. Main
// thread; a few file-system calls, `last` one per session.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace app {

/// dataFolder("sessions").
std::filesystem::path usualSessionFolder();

/// A free name in the folder: "2026-11-24-154322-tooth-48.molar" for local time. `fdi` 0: no tooth.
std::string newSessionPath(const std::filesystem::path& folder, std::int64_t unix_s, int fdi);

/// The newest session of the usual folder for "last" (killed ones included, one that is being recorded not), any other
/// text unchanged. Throws SessionError if there is none.
std::string sessionNamed(const std::string& text);

/// Of an argument that names a session.
inline constexpr const char* kSessionHelp = "Session file, or last: the newest in the data folder";

/// When its file or its log was written last.
std::filesystem::file_time_type lastWritten(const std::filesystem::path& session);

}  // namespace app
