#include "calibration/webcam/webcam_file.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/checked_yaml.h"
#include "calibration/geometry/units.h"
#include "calibration/webcam/camera_block.h"

namespace calibration {
namespace {

constexpr const char* kKind = "molar_webcam_observations";
constexpr std::size_t kMostPositions = 12, kMostPlaces = 20'000, kMostTips = 1'000;
constexpr double kFarthest_mm = 2000.0, kMostTurned_rad = 4.0 * kPi;
constexpr double kLeastNoise_px = 0.01, kMostNoise_px = 20.0;
constexpr int kLargestId = 1'000'000;

/// One file; `where` in its functions is how refusals call the place.
class Reader {
 public:
  explicit Reader(const std::string& path) : yaml_("webcam observations", path) {}

  WebcamObservationFile observations() {
    const cv::FileNode root = yaml_.root(), kind = root["kind"];
    if (!kind.isString() || kind.string() != kKind)
      yaml_.refuse("it holds no webcam observations (kind: \"molar_webcam_observations\" missing)",
                   "give the file that the webcam procedure wrote");
    yaml_.integer(root, "schema", 1, 1);
    WebcamObservationFile all;
    all.sights.device_model = yaml_.text(root, "device_model");
    if (!findPhantomModel(all.sights.device_model))
      yaml_.refuse("device_model '" + all.sights.device_model + "' is not known", "give a key of molar devices");
    if (yaml_.has(root, "serial")) all.serial = yaml_.text(root, "serial");
    if (yaml_.has(root, "mount")) all.mount = yaml_.text(root, "mount");
    all.sights.camera = cameraIn(yaml_, yaml_.map(root, "camera"));
    const auto noise_px = yaml_.numbers(root["noise_px"], "noise_px", 2);
    for (const double sigma : noise_px)
      if (sigma < kLeastNoise_px || sigma > kMostNoise_px)
        yaml_.refuse("'noise_px' is not between 0.01 and 20 px",
                     "give one sigma of the screen's places and of the tip");
    all.sights.screen_noise_px = noise_px[0], all.sights.tip_noise_px = noise_px[1];
    size_px_ = all.sights.camera.size_px;

    for (const cv::FileNode& node : list(root["positions"], "positions", kMostPositions))
      all.sights.positions.push_back(position(node, all.sights.positions.size()));
    return all;
  }

 private:
  /// A list that is not too long.
  cv::FileNode list(const cv::FileNode& node, const std::string& where, std::size_t most) const {
    if (!node.isSeq()) yaml_.refuse("'" + where + "' is missing or no list", "run the webcam procedure again");
    if (node.size() > most)
      yaml_.refuse("'" + where + "' has more than " + std::to_string(most) + " entries", "give those of one procedure");
    return node;
  }

  glm::dvec2 pixel(double u, double v, const std::string& where) const {
    // Half a image beside it at the most: nothing is seen there.
    if (std::abs(u - 0.5 * size_px_.x) > size_px_.x || std::abs(v - 0.5 * size_px_.y) > size_px_.y)
      yaml_.refuse(where + ": a pixel lies far beside the picture", "measure again");
    return {u, v};
  }

  ScreenObservation place(const cv::FileNode& node, const std::string& where) const {
    const auto n = yaml_.numbers(node, where, 5);
    if (std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])}) > kFarthest_mm)
      yaml_.refuse(where + " is beyond 2 m", "give mm in frame W");
    return {{{n[0], n[1], n[2]}}, pixel(n[3], n[4], where)};
  }

  TipObservation tip(const cv::FileNode& node, const std::string& where) const {
    if (!node.isMap()) yaml_.refuse(where + " is no map", "write { id, joints_rad: [6], camera_px: [2] }");
    TipObservation tip;
    tip.id = yaml_.integer(node, "id", 0, kLargestId);
    const auto joints = yaml_.numbers(node["joints_rad"], where + ": joints_rad", tip.joints_rad.size());
    if (std::ranges::any_of(joints, [](double angle) { return std::abs(angle) > kMostTurned_rad; }))
      yaml_.refuse(where + ": an angle is beyond two turns", "give radians");
    std::ranges::copy(joints, tip.joints_rad.begin());
    const auto px = yaml_.numbers(node["camera_px"], where + ": camera_px", 2);
    tip.camera_px = pixel(px[0], px[1], where);
    return tip;
  }

  CameraPosition position(const cv::FileNode& node, std::size_t at) const {
    const std::string where = "position " + std::to_string(at + 1);
    if (!node.isMap()) yaml_.refuse(where + " is no map", "run the webcam procedure again");
    CameraPosition position;
    const auto named = [&](const char* what, std::size_t i) {
      return where + ", " + what + " " + std::to_string(i + 1);
    };
    for (const cv::FileNode& item : list(node["screen"], where + ": screen", kMostPlaces))
      position.screen.push_back(place(item, named("place", position.screen.size())));
    for (const cv::FileNode& item : list(node["tips"], where + ": tips", kMostTips))
      position.tips.push_back(tip(item, named("tip", position.tips.size())));
    return position;
  }

  CheckedYaml yaml_;
  glm::ivec2 size_px_{0};
};

}  // namespace

bool isWebcamFile(const std::string& path) {
  try {
    const CheckedYaml yaml("file", path);
    const cv::FileNode kind = yaml.root()["kind"];
    return kind.isString() && kind.string() == kKind;
  } catch (const CalibrationError&) {
    return false;
  }
}

WebcamObservationFile readWebcamFile(const std::string& path) { return Reader(path).observations(); }

std::string webcamFileText(const WebcamObservationFile& observations) {
  const WebcamObservations& sights = observations.sights;
  const std::string open = "[:", close = "]", open_map = "{", close_map = "}";
  cv::FileStorage out("webcam.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  const auto pair = [&](const char* key, const glm::dvec2& v) { out << key << open << v.x << v.y << close; };
  out << "schema" << 1 << "kind" << std::string(kKind) << "device_model" << sights.device_model;
  if (!observations.serial.empty()) out << "serial" << observations.serial;
  if (!observations.mount.empty()) out << "mount" << observations.mount;
  out << "camera" << open_map;
  writeCamera(out, sights.camera);
  out << close_map;
  pair("noise_px", {sights.screen_noise_px, sights.tip_noise_px});
  out << "positions" << std::string("[");
  for (const CameraPosition& position : sights.positions) {
    out << open_map << "screen" << std::string("[");
    for (const ScreenObservation& place : position.screen)
      out << open << place.position_W.mm.x << place.position_W.mm.y << place.position_W.mm.z << place.camera_px.x
          << place.camera_px.y << close;
    out << close << "tips" << std::string("[");
    for (const TipObservation& tip : position.tips) {
      out << open_map << "id" << tip.id << "joints_rad" << open;
      for (const double angle_rad : tip.joints_rad) out << angle_rad;
      out << close;
      pair("camera_px", tip.camera_px);
      out << close_map;
    }
    out << close << close_map;
  }
  out << close;
  return out.releaseAndGetString();
}

}  // namespace calibration
