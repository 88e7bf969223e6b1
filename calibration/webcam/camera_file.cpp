#include "calibration/webcam/camera_file.h"

#include <cmath>

#include <opencv2/core.hpp>

#include "calibration/checked_yaml.h"

namespace calibration {
namespace {

constexpr int kSchema = 1;

/// A lens that a webcam can have: fits its picture, sees 10 to 150 degrees, bends less than a fish-eye.
void checkLens(const CheckedYaml& yaml, const CameraModel& camera) {
  const auto refuse = [&](const char* key) {
    yaml.refuse(std::string("'") + key + "' is not that of a webcam's lens", "measure the camera again");
  };
  for (int axis = 0; axis < 2; ++axis) {
    const double size = camera.size_px[axis];
    if (camera.focal_px[axis] < 0.15 * size || camera.focal_px[axis] > 8.0 * size) refuse("focal_px");
    if (camera.centre_px[axis] < 0.1 * size || camera.centre_px[axis] > 0.9 * size) refuse("centre_px");
  }
  if (std::abs(camera.k1) > 2.0 || std::abs(camera.k2) > 20.0 || std::abs(camera.p1) > 0.2 || std::abs(camera.p2) > 0.2)
    refuse("distortion");
}

}  // namespace

CameraRecord readCamera(const std::string& path) {
  const CheckedYaml yaml("camera file", path);
  const cv::FileNode root = yaml.root(), kind = root["kind"];
  if (!kind.isString() || kind.string() != "molar_camera")
    yaml.refuse("it is not a camera file (kind: \"molar_camera\" missing)", "give the file that calibration wrote");
  if (!root["schema"].isInt() || static_cast<int>(root["schema"]) != kSchema)
    yaml.refuse("its schema is not 1", "update the program or the file");

  CameraRecord record;
  record.name = yaml.text(root, "name");
  record.serial = yaml.text(root, "serial");
  record.measured_utc = yaml.text(root, "measured_utc");
  record.rms_px = yaml.number(root, "rms_px");
  record.views = yaml.integer(root, "views", 0, 10000);
  if (record.rms_px < 0.0) yaml.refuse("'rms_px' is negative", "measure the camera again");

  const auto size = yaml.numbers(root["size_px"], "size_px", 2);
  for (const double v : size)
    if (v < 16 || v > 16384 || v != std::floor(v))
      yaml.refuse("'size_px' is not a picture size", "give whole pixels between 16 and 16384");
  CameraModel& camera = record.camera;
  camera.size_px = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  const auto focal = yaml.numbers(root["focal_px"], "focal_px", 2);
  const auto centre = yaml.numbers(root["centre_px"], "centre_px", 2);
  const auto bent = yaml.numbers(root["distortion"], "distortion", 4);
  camera.focal_px = {focal[0], focal[1]};
  camera.centre_px = {centre[0], centre[1]};
  camera.k1 = bent[0], camera.k2 = bent[1], camera.p1 = bent[2], camera.p2 = bent[3];
  checkLens(yaml, camera);
  return record;
}

std::string cameraText(const CameraRecord& record) {
  const CameraModel& camera = record.camera;
  cv::FileStorage out("camera.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  out << "schema" << kSchema << "kind" << std::string("molar_camera");
  out << "name" << record.name << "serial" << record.serial << "measured_utc" << record.measured_utc;
  out << "size_px" << std::string("[:") << camera.size_px.x << camera.size_px.y << std::string("]");
  out << "focal_px" << std::string("[:") << camera.focal_px.x << camera.focal_px.y << std::string("]");
  out << "centre_px" << std::string("[:") << camera.centre_px.x << camera.centre_px.y << std::string("]");
  out << "distortion" << std::string("[:") << camera.k1 << camera.k2 << camera.p1 << camera.p2 << std::string("]");
  out << "rms_px" << record.rms_px << "views" << record.views;
  return out.releaseAndGetString();
}

}  // namespace calibration
