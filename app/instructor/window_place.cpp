#include "app/instructor/window_place.h"

#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include <fmt/core.h>

#include "assets/toml_reader.h"
#include "calibration/output_file.h"

namespace app {

using render::DesktopBox;

std::optional<DesktopBox> placeBeside(const DesktopBox& surgeons, const DesktopBox& monitor) {
  const glm::ivec2 low = monitor.at_px, high = monitor.at_px + monitor.size_px;
  const glm::ivec2 taken_low = glm::clamp(surgeons.at_px, low, high);
  const glm::ivec2 taken_high = glm::clamp(surgeons.at_px + surgeons.size_px, low, high);
  // Right, left, below, above.
  const std::array strips{DesktopBox{{taken_high.x, low.y}, {high.x - taken_high.x, monitor.size_px.y}},
                          DesktopBox{low, {taken_low.x - low.x, monitor.size_px.y}},
                          DesktopBox{{low.x, taken_high.y}, {monitor.size_px.x, high.y - taken_high.y}},
                          DesktopBox{low, {monitor.size_px.x, taken_low.y - low.y}}};
  std::optional<DesktopBox> best;
  for (DesktopBox strip : strips) {
    strip.size_px = glm::min(strip.size_px, kUsualInstructor_px);
    if (glm::any(glm::lessThan(strip.size_px, kLeastInstructor_px))) continue;
    if (!best || strip.size_px.x * strip.size_px.y > best->size_px.x * best->size_px.y) best = strip;
  }
  return best;
}

bool areApart(const DesktopBox& one, const DesktopBox& other) {
  const glm::ivec2 shared =
      glm::min(one.at_px + one.size_px, other.at_px + other.size_px) - glm::max(one.at_px, other.at_px);
  return shared.x <= 0 || shared.y <= 0;
}

std::string instructorWindowFile() {
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  const std::string folder = config != nullptr && *config != '\0'
                                 ? std::string(config)
                                 : std::string(home != nullptr ? home : ".") + "/.config";
  return folder + "/molar/instructor_window.toml";
}

std::optional<DesktopBox> rememberedPlace(const std::string& file) {
  try {
    if (!std::filesystem::exists(file)) return {};
    assets::TomlReader keys = assets::TomlReader::fromFile(file);
    const auto pair = [&](const char* key) {
      const std::vector<double> values = keys.numbers("", key, {-100'000.0, 100'000.0}, 2, 2);
      return glm::ivec2(static_cast<int>(values[0]), static_cast<int>(values[1]));
    };
    const DesktopBox place{pair("at_px"), pair("size_px")};
    if (glm::any(glm::lessThan(place.size_px, kLeastInstructor_px))) return {};
    return place;
  } catch (const std::exception&) {
    return {};
  }
}

void rememberPlace(const std::string& file, const DesktopBox& place) {
  try {
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    calibration::OutputFile output(file, true);
    output.commit(
        fmt::format("# Where the instructor's window was closed, px of the desktop.\nat_px = [{}, {}]\n"
                    "size_px = [{}, {}]\n",
                    place.at_px.x, place.at_px.y, place.size_px.x, place.size_px.y));
  } catch (const std::exception&) {
    // It opens beside the picture again.
  }
}

}  // namespace app
