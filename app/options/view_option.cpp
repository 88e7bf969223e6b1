#include "app/options/view_option.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "calibration/geometry/units.h"
#include "calibration/record/utc.h"
#include "render/display/camera.h"
#include "render/gpu/gpu_error.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxCamera_bytes = 1u << 16;
constexpr double kMaxCoordinate_mm = 1e5;

glm::dvec3 vectorIn(const json& camera, const char* key) {
  if (!camera.contains(key)) throw UsageError(std::string("--camera: '") + key + "' is missing, give three numbers");
  const json& v = camera.at(key);
  if (!v.is_array() || v.size() != 3)
    throw UsageError(std::string("--camera: '") + key + "' is not three numbers, correct it");
  glm::dvec3 out{0.0};
  for (int a = 0; a < 3; ++a) {
    const json& number = v.at(static_cast<std::size_t>(a));
    if (!number.is_number() || !(std::abs(number.get<double>()) < kMaxCoordinate_mm))
      throw UsageError(std::string("--camera: '") + key + "' is not three finite numbers, correct it");
    out[a] = number.get<double>();
  }
  return out;
}

/// The option is the JSON text or the name of a file.
std::string cameraText(const std::string& option) {
  if (option.find('{') != std::string::npos) return option;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(option, error);
  std::ifstream file(option);
  if (error || !file) throw UsageError("--camera " + option + ": it cannot be read, give JSON or a file of it");
  if (bytes > kMaxCamera_bytes)
    throw UsageError("--camera " + option + ": it is too long for a camera, check the path");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

render::Camera cameraFrom(const std::string& option) {
  const json camera = json::parse(cameraText(option), nullptr, false);
  if (!camera.is_object())
    throw UsageError("--camera: it is not JSON, give {\"eye_mm\":[…],\"look_at_mm\":[…],\"up\":[…],\"fov_y_deg\":30}");
  for (const auto& [key, value] : camera.items())
    if (!std::set<std::string>{"eye_mm", "look_at_mm", "up", "fov_y_deg"}.contains(key))
      throw UsageError("--camera: '" + key + "' is not a key of a camera, remove it");
  render::Camera out;
  out.eye_P_mm = vectorIn(camera, "eye_mm");
  out.look_at_P_mm = vectorIn(camera, "look_at_mm");
  if (camera.contains("up")) out.up_P = vectorIn(camera, "up");
  if (camera.contains("fov_y_deg")) {
    const json& fov = camera.at("fov_y_deg");
    if (!fov.is_number() || !(fov.get<double>() >= 1.0 && fov.get<double>() <= 150.0))
      throw UsageError("--camera: 'fov_y_deg' is out of range, give 1 to 150");
    out.fov_y_rad = calibration::radFromDegrees(fov.get<double>());
  }
  return out;
}

/// Three-quarter view of the whole volume.
render::Camera cameraOn(const assets::VolumeGrid& grid) {
  render::Camera camera;
  const glm::dvec3 extent = grid.spacing_mm * glm::dvec3(grid.size);
  camera.look_at_P_mm = grid.origin_P_mm + 0.5 * extent;
  camera.eye_P_mm = camera.look_at_P_mm + 2.2 * glm::length(extent) * glm::normalize(glm::dvec3(-0.7, -1.0, 0.6));
  return camera;
}

}  // namespace

glm::ivec2 imageSize(const std::string& text) {
  const std::vector<std::string_view> edges = split(text, 'x');
  glm::ivec2 px{0};
  if (edges.size() == 2) px = {parseNumber<int>(edges[0]).value_or(0), parseNumber<int>(edges[1]).value_or(0)};
  if (px.x < 16 || px.y < 16 || px.x > 16384 || px.y > 16384)
    throw UsageError("--size " + text + ": not an image size, give WIDTHxHEIGHT, each 16 to 16384");
  return px;
}

void ViewOption::addTo(CommandLine& command) {
  Option rig = rig_.addTo(command, false);
  command.option("--eye", eye_, "Which eye of the rig: left, right or cyclopean").oneOf({"left", "right", "cyclopean"});
  command
      .option("--camera", camera_,
              "Instead of a rig: {\"eye_mm\":[x,y,z],\"look_at_mm\":[…],\"up\":[…],\"fov_y_deg\":30}")
      .valueNamed("JSON")
      .excludes(rig);
  command.option("--size", size_, "Picture size (default: the rig's screen, or 640x480)").valueNamed("WxH");
}

render::Eye ViewOption::apply(calibration::Rig& rig, const assets::VolumeGrid& grid) const {
  if (rig_.isGiven()) {
    rig = rig_.choose({}, calibration::nowUtc())->record.rig;
    if (!size_.empty()) rig.screen.px = imageSize(size_);
  } else {
    const glm::ivec2 px = size_.empty() ? glm::ivec2(640, 480) : imageSize(size_);
    const render::Camera camera = camera_.empty() ? cameraOn(grid) : cameraFrom(camera_);
    try {
      rig = render::cameraRig(camera, px);
    } catch (const render::GpuError& no_view) {
      throw UsageError(std::string("--camera: ") + no_view.what());
    }
  }
  return eye_ == "left" ? render::Eye::left : eye_ == "right" ? render::Eye::right : render::Eye::cyclopean;
}

}  // namespace app
