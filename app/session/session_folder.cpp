#include "app/session/session_folder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "app/session/data_folder.h"
#include "app/session/recording_file.h"
#include "app/session/session_error.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxSameSecond = 999;

}  // namespace

fs::path usualSessionFolder() { return dataFolder("sessions"); }

std::string newSessionPath(const fs::path& folder, std::int64_t unix_s, int fdi) {
  const std::string name = datedName(unix_s, fdi);
  const auto is_taken = [&](const std::string& stem) {
    std::error_code failed;
    for (const std::string& file : sessionFiles((folder / (stem + ".molar")).string()))
      if (fs::exists(file, failed) || fs::exists(file + ".new", failed)) return true;
    return false;
  };
  std::string stem = name;
  for (int n = 2; is_taken(stem) && n <= kMaxSameSecond; ++n) stem = fmt::format("{}-{}", name, n);
  return (folder / (stem + ".molar")).string();
}

fs::file_time_type lastWritten(const fs::path& session) {
  std::error_code failed;
  fs::file_time_type newest = fs::file_time_type::min();
  for (const char* const ending : {"", "-wal"}) {
    const auto written = fs::last_write_time(session.string() + ending, failed);
    if (!failed) newest = std::max(newest, written);
  }
  return newest;
}

std::string sessionNamed(const std::string& text) {
  if (text != "last") return text;
  const fs::path folder = usualSessionFolder();
  std::error_code failed;
  std::optional<fs::path> newest;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const fs::path& path = entry.path();
    if (path.extension() != ".molar" || !entry.is_regular_file(failed) || isBeingRecorded(path.string())) continue;
    if (!newest || std::pair(lastWritten(path), path) > std::pair(lastWritten(*newest), *newest)) newest = path;
  }
  if (!newest) throw SessionError("last: there is no session in " + folder.string() + ": name a session file");
  return newest->string();
}

}  // namespace app
