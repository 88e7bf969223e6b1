#include "calibration/webcam/webcam_file.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/checked_yaml.h"
#include "calibration/fit/touches_file.h"
#include "calibration/webcam/camera_file.h"

namespace calibration {
namespace {

constexpr const char* kKind = "molar_webcam_observations";
constexpr std::size_t kMaxPositions = 12, kMaxPlaces = 20'000, kMaxTips = 1'000;
constexpr double kMinNoise_px = 0.01, kMaxNoise_px = 20.0;
constexpr int kLargestId = 1'000'000;

/// `where`: the entry's name in messages.
class Reader {
 public:
  explicit Reader(const std::string& path) : yaml_("webcam observations file", path) {}

  WebcamObservations observations() {
    const cv::FileNode root = yaml_.root();
    yaml_.checkKind(kKind);
    WebcamObservations all;
    all.device_model = yaml_.text(root, "device_model");
    if (!findPhantomModel(all.device_model))
      yaml_.refuse("device_model '" + all.device_model + "' is not known", "give one of " + phantomModelKeys());
    if (yaml_.has(root, "serial")) all.serial = yaml_.text(root, "serial");
    if (yaml_.has(root, "mount")) all.mount = yaml_.text(root, "mount");
    all.camera = cameraIn(yaml_, yaml_.map(root, "camera"));
    const auto noise_px = yaml_.numbers(root["noise_px"], "noise_px", 2);
    for (const double sigma : noise_px)
      if (sigma < kMinNoise_px || sigma > kMaxNoise_px)
        yaml_.refuse("'noise_px' is not between 0.01 and 20 px", "give one sigma of the screen points and of the tip");
    all.screen_noise_px = noise_px[0], all.tip_noise_px = noise_px[1];
    size_px_ = all.camera.size_px;

    for (const cv::FileNode& node : list(root["positions"], "positions", kMaxPositions))
      all.positions.push_back(position(node, all.positions.size()));
    return all;
  }

 private:
  /// A list of limited length.
  cv::FileNode list(const cv::FileNode& node, const std::string& where, std::size_t most) const {
    if (!node.isSeq()) yaml_.refuse("'" + where + "' is missing or not a list", "run the webcam procedure again");
    if (node.size() > most)
      yaml_.refuse("'" + where + "' has more than " + std::to_string(most) + " entries", "give those of one procedure");
    return node;
  }

  glm::dvec2 pixel(double u, double v, const std::string& where) const {
    // At most half an image outside it.
    if (std::abs(u - 0.5 * size_px_.x) > size_px_.x || std::abs(v - 0.5 * size_px_.y) > size_px_.y)
      yaml_.refuse(where + ": a pixel lies far outside the image", "measure again");
    return {u, v};
  }

  ScreenObservation screenPoint(const cv::FileNode& node, const std::string& where) const {
    const auto n = yaml_.numbers(node, where, 5);
    if (std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])}) > kFarthest.most)
      yaml_.refuse(where + " is beyond " + kFarthest.name, kFarthest.mend);
    return {{{n[0], n[1], n[2]}}, pixel(n[3], n[4], where)};
  }

  TipObservation tip(const cv::FileNode& node, const std::string& where) const {
    if (!node.isMap()) yaml_.refuse(where + " is not a map", "write { id, joints_rad: [6], camera_px: [2] }");
    TipObservation tip;
    tip.id = yaml_.integer(node, "id", 0, kLargestId, where + ": ");
    tip.joints_rad = jointsIn(yaml_, node, where);
    const auto px = yaml_.numbers(node["camera_px"], where + ": camera_px", 2);
    tip.camera_px = pixel(px[0], px[1], where);
    return tip;
  }

  CameraPosition position(const cv::FileNode& node, std::size_t at) const {
    const std::string where = "position " + std::to_string(at + 1);
    if (!node.isMap()) yaml_.refuse(where + " is not a map", "run the webcam procedure again");
    CameraPosition position;
    const auto named = [&](const char* what, std::size_t i) {
      return where + ", " + what + " " + std::to_string(i + 1);
    };
    for (const cv::FileNode& item : list(node["screen"], where + ": screen", kMaxPlaces))
      position.screen.push_back(screenPoint(item, named("point", position.screen.size())));
    for (const cv::FileNode& item : list(node["tips"], where + ": tips", kMaxTips))
      position.tips.push_back(tip(item, named("tip", position.tips.size())));
    return position;
  }

  CheckedYaml yaml_;
  glm::ivec2 size_px_{0};
};

}  // namespace

bool isWebcamFile(const std::string& path) {
  try {
    return CheckedYaml("file", path).isKind(kKind);
  } catch (const CalibrationError&) {
    return false;
  }
}

WebcamObservations readWebcamFile(const std::string& path) { return Reader(path).observations(); }

std::string webcamFileText(const WebcamObservations& observations) {
  YamlWriter out;
  out.put({{"schema", 1}, {"kind", kKind}, {"device_model", observations.device_model}});
  if (!observations.serial.empty()) out.put("serial", observations.serial);
  if (!observations.mount.empty()) out.put("mount", observations.mount);
  out.openMap("camera");
  writeCamera(out, observations.camera);
  out.close();
  out.put("noise_px", glm::dvec2(observations.screen_noise_px, observations.tip_noise_px));
  out.openList("positions");
  for (const CameraPosition& position : observations.positions) {
    out.openMap();
    out.openList("screen");
    for (const ScreenObservation& one : position.screen) {
      const glm::dvec3& mm = one.position_W.mm;
      out.entry(std::array{mm.x, mm.y, mm.z, one.camera_px.x, one.camera_px.y});
    }
    out.close();
    out.openList("tips");
    for (const TipObservation& tip : position.tips)
      out.map({}, {{"id", tip.id}, {"joints_rad", tip.joints_rad}, {"camera_px", tip.camera_px}});
    out.close();
    out.close();
  }
  out.close();
  return out.text();
}

}  // namespace calibration
