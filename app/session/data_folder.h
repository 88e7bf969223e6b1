// The user's data folder and the names of the files that a rehearsal leaves in it: date, time and tooth, nothing of a
// person. Any thread but the servo; a few file-system calls.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace app {

/// $XDG_DATA_HOME/molar/NAME or ~/.local/share/molar/NAME. Throws SessionError if neither is known.
std::filesystem::path dataFolder(const std::string& name);

/// Saved pictures: dataFolder("pictures").
std::filesystem::path usualPictureFolder();

/// Creates the folder if needed. Throws SessionError: no file can be written there.
void makeDataFolder(const std::filesystem::path& folder);

/// "2026-11-24-154322-tooth-48" for local time. `fdi` 0: no tooth.
std::string datedName(std::int64_t unix_s, int fdi);

/// A free name in the folder: "2026-11-24-154322-tooth-48.png", then "…-48-2.png".
std::string newPicturePath(const std::filesystem::path& folder, std::int64_t unix_s, int fdi);

}  // namespace app
