#include "calibration/webcam/camera_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>

namespace calibration {
namespace {

constexpr double kSmallest_px = 16.0, kLargest_px = 16384.0;
constexpr double kMinFocal = 0.15, kMaxFocal = 8.0;             ///< of the image's side
constexpr double kMinCentre = 0.1, kMaxCentre = 0.9;            ///< of the image's side
constexpr double kMaxUnsquare = 0.1;                            ///< ratio of the focal lengths minus 1
constexpr std::array<double, 4> kMaxBent{2.0, 20.0, 0.2, 0.2};  ///< k1, k2, p1, p2

/// False for NaN.
bool isWithin(double value, double least, double most) { return value >= least && value <= most; }

}  // namespace

std::string_view implausibleParameter(const CameraModel& camera) {
  for (int axis = 0; axis < 2; ++axis) {
    const double side = camera.size_px[axis];
    if (!isWithin(side, kSmallest_px, kLargest_px)) return "size_px";
    if (!isWithin(camera.focal_px[axis], kMinFocal * side, kMaxFocal * side)) return "focal_px";
    if (!isWithin(camera.centre_px[axis], kMinCentre * side, kMaxCentre * side)) return "centre_px";
  }
  if (std::abs(camera.focal_px.y / camera.focal_px.x - 1.0) > kMaxUnsquare) return "focal_px";
  const std::array bent{camera.k1, camera.k2, camera.p1, camera.p2};
  for (std::size_t i = 0; i < bent.size(); ++i)
    if (!isWithin(bent[i], -kMaxBent[i], kMaxBent[i])) return "distortion";
  return "";
}

CameraModel cameraIn(const CheckedYaml& yaml, const cv::FileNode& node) {
  const auto size = yaml.numbers(node["size_px"], "size_px", 2);
  if (std::ranges::any_of(size, [](double v) { return v != std::floor(v) || !isWithin(v, kSmallest_px, kLargest_px); }))
    yaml.refuse("'size_px' is not an image size", "give whole pixels between 16 and 16384");
  const auto focal = yaml.numbers(node["focal_px"], "focal_px", 2);
  const auto centre = yaml.numbers(node["centre_px"], "centre_px", 2);
  const auto bent = yaml.numbers(node["distortion"], "distortion", 4);
  const CameraModel camera{{static_cast<int>(size[0]), static_cast<int>(size[1])},
                           {focal[0], focal[1]},
                           {centre[0], centre[1]},
                           bent[0],
                           bent[1],
                           bent[2],
                           bent[3]};
  if (const std::string_view key = implausibleParameter(camera); !key.empty())
    yaml.refuse("'" + std::string(key) + "' is implausible for a webcam's lens", "measure the camera again");
  return camera;
}

void writeCamera(YamlWriter& out, const CameraModel& camera) {
  out.put({{"size_px", camera.size_px},
           {"focal_px", camera.focal_px},
           {"centre_px", camera.centre_px},
           {"distortion", std::array{camera.k1, camera.k2, camera.p1, camera.p2}}});
}

CameraRecord readCamera(const std::string& path) {
  const CheckedYaml yaml("camera file", path);
  const cv::FileNode root = yaml.root();
  yaml.checkKind("molar_camera");

  CameraRecord record;
  record.name = yaml.text(root, "name");
  record.serial = yaml.text(root, "serial");
  record.measured_utc = yaml.text(root, "measured_utc");
  record.rms_px = yaml.number(root, "rms_px");
  record.views = yaml.integer(root, "views", 0, 10000);
  if (record.rms_px < 0.0) yaml.refuse("'rms_px' is negative", "measure the camera again");
  record.camera = cameraIn(yaml, root);
  return record;
}

std::string cameraText(const CameraRecord& record) {
  YamlWriter out;
  out.put({{"schema", 1},
           {"kind", "molar_camera"},
           {"name", record.name},
           {"serial", record.serial},
           {"measured_utc", record.measured_utc}});
  writeCamera(out, record.camera);
  out.put({{"rms_px", record.rms_px}, {"views", record.views}});
  return out.text();
}

}  // namespace calibration
