#include "app/session/data_folder.h"

#include <unistd.h>

#include <cstdlib>
#include <ctime>

#include <fmt/chrono.h>

#include "app/session/session_error.h"

namespace app {

std::filesystem::path dataFolder(const std::string& name) {
  // Relative paths are ignored (XDG Base Directory Specification).
  if (const char* const data = std::getenv("XDG_DATA_HOME"); data != nullptr && data[0] == '/')
    return std::filesystem::path(data) / "molar" / name;
  if (const char* const own = std::getenv("HOME"); own != nullptr && own[0] == '/')
    return std::filesystem::path(own) / ".local" / "share" / "molar" / name;
  throw SessionError("no folder for " + name + " is known: set HOME or XDG_DATA_HOME to a folder");
}

std::filesystem::path usualPictureFolder() { return dataFolder("pictures"); }

void makeDataFolder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed || !std::filesystem::is_directory(folder, failed) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw SessionError(folder.string() + ": cannot be written: check the folder and its permissions");
}

std::string datedName(std::int64_t unix_s, int fdi) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:%Y-%m-%d-%H%M%S}-", local) + (fdi > 0 ? fmt::format("tooth-{}", fdi) : "jaw");
}

std::string newPicturePath(const std::filesystem::path& folder, std::int64_t unix_s, int fdi) {
  const std::string name = datedName(unix_s, fdi);
  std::string path = (folder / (name + ".png")).string();
  std::error_code failed;
  for (int n = 2; std::filesystem::exists(path, failed); ++n)
    path = (folder / fmt::format("{}-{}.png", name, n)).string();
  return path;
}

}  // namespace app
