#include "app/device/falcon_scale_file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>

#include "assets/toml_reader.h"
#include "calibration/output_file.h"

namespace app {
namespace {

constexpr std::int64_t kVersion = 1;

/// A serial number that needs no quoting; anything else is left out.
bool isPlain(const std::string& text) {
  return std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_';
  });
}

}  // namespace

std::string defaultFalconScaleFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config != '\0') return std::string(config) + "/molar/falcon.toml";
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr ? home : ".") + "/.config/molar/falcon.toml";
}

haptics::FalconForceScale savedFalconScale(const std::string& path) {
  return std::filesystem::exists(path) ? readFalconScale(path) : haptics::FalconForceScale();
}

haptics::FalconForceScale readFalconScale(const std::string& path) {
  assets::TomlReader keys = assets::TomlReader::fromFile(path);
  keys.integer("", "version", kVersion, kVersion);
  haptics::FalconForceScale scale;
  scale.serial = keys.text("", "serial", "");
  scale.words_per_Nmm = keys.number("", "words_per_Nmm", {2.0, 50.0});
  scale.max_weighed_N = keys.number("", "heaviest_N", {0.2, 10.0, "N"});
  keys.refuseUnknownKeys();
  return scale;
}

void writeFalconScale(const std::string& path, const haptics::FalconForceScale& scale, bool overwrite) {
  haptics::check(scale);
  calibration::OutputFile file(path, overwrite);
  std::string text =
      fmt::format("# The force of a Novint Falcon as a spring scale showed it.\nversion = {}\n", kVersion);
  if (isPlain(scale.serial) && !scale.serial.empty()) text += fmt::format("serial = \"{}\"\n", scale.serial);
  text += fmt::format("words_per_Nmm = {:.9g}\nheaviest_N = {:.9g}\n", scale.words_per_Nmm, scale.max_weighed_N);
  file.commit(text);
}

}  // namespace app
