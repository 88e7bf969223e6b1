#include "calibration/webcam/camera_file.h"

#include <opencv2/core.hpp>

#include "calibration/checked_yaml.h"
#include "calibration/webcam/camera_block.h"

namespace calibration {
namespace {

constexpr int kSchema = 1;

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

  record.camera = cameraIn(yaml, root);
  return record;
}

std::string cameraText(const CameraRecord& record) {
  cv::FileStorage out("camera.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  out << "schema" << kSchema << "kind" << std::string("molar_camera");
  out << "name" << record.name << "serial" << record.serial << "measured_utc" << record.measured_utc;
  writeCamera(out, record.camera);
  out << "rms_px" << record.rms_px << "views" << record.views;
  return out.releaseAndGetString();
}

}  // namespace calibration
