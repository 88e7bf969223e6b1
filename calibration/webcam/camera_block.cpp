#include "calibration/webcam/camera_block.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>

namespace calibration {
namespace {

constexpr double kSmallest_px = 16.0, kLargest_px = 16384.0;
constexpr double kLeastFocal = 0.15, kMostFocal = 8.0;           ///< of the image's side
constexpr double kLeastCentre = 0.1, kMostCentre = 0.9;          ///< of the image's side
constexpr double kMostUnsquare = 0.1;                            ///< one focal length over the other, less 1
constexpr std::array<double, 4> kMostBent{2.0, 20.0, 0.2, 0.2};  ///< k1, k2, p1, p2

/// Not a number is never within.
bool isWithin(double value, double least, double most) { return value >= least && value <= most; }

}  // namespace

std::string_view implausibleParameter(const CameraModel& camera) {
  for (int axis = 0; axis < 2; ++axis) {
    const double side = camera.size_px[axis];
    if (!isWithin(side, kSmallest_px, kLargest_px)) return "size_px";
    if (!isWithin(camera.focal_px[axis], kLeastFocal * side, kMostFocal * side)) return "focal_px";
    if (!isWithin(camera.centre_px[axis], kLeastCentre * side, kMostCentre * side)) return "centre_px";
  }
  if (std::abs(camera.focal_px.y / camera.focal_px.x - 1.0) > kMostUnsquare) return "focal_px";
  const std::array bent{camera.k1, camera.k2, camera.p1, camera.p2};
  for (std::size_t i = 0; i < bent.size(); ++i)
    if (!isWithin(bent[i], -kMostBent[i], kMostBent[i])) return "distortion";
  return "";
}

CameraModel cameraIn(const CheckedYaml& yaml, const cv::FileNode& node) {
  const auto size = yaml.numbers(node["size_px"], "size_px", 2);
  if (std::ranges::any_of(size, [](double v) { return v != std::floor(v) || !isWithin(v, kSmallest_px, kLargest_px); }))
    yaml.refuse("'size_px' is not a picture size", "give whole pixels between 16 and 16384");
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
    yaml.refuse("'" + std::string(key) + "' is no lens that a webcam can have", "measure the camera again");
  return camera;
}

void writeCamera(cv::FileStorage& out, const CameraModel& camera) {
  const std::string open = "[:", close = "]";
  out << "size_px" << open << camera.size_px.x << camera.size_px.y << close;
  out << "focal_px" << open << camera.focal_px.x << camera.focal_px.y << close;
  out << "centre_px" << open << camera.centre_px.x << camera.centre_px.y << close;
  out << "distortion" << open << camera.k1 << camera.k2 << camera.p1 << camera.p2 << close;
}

}  // namespace calibration
