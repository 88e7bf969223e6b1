#include "calibration/record/rig_block_reader.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"
#include "calibration/rig.h"

namespace calibration {
namespace {

constexpr int kLargestScreen_px = 16384;
constexpr double kSameWritten = 1e-9;  ///< tolerance of a value written twice

// Beyond any working arm.
constexpr double kMaxGain = 0.10, kMaxOffset_rad = radFromDegrees(30.0), kMaxLength_mm = 20.0;
constexpr double kMaxQuadratic_per_rad = 0.10, kMaxTilt_rad = radFromDegrees(10.0), kMaxTip_mm = 250.0;

template <class A, class B>
Pose<A, B> poseIn(const CheckedYaml& yaml, const char* key, double tolerance) {
  const CheckedYaml::Rigid rigid = exactPose(yaml, yaml.root(), key, tolerance);
  return {rigid.rotation, rigid.translation_mm};
}

ScreenCorners screenIn(const CheckedYaml& yaml) {
  const cv::FileNode node = yaml.map(yaml.root(), "screen");
  const auto px = yaml.numbers(node["px"], "px", 2);
  for (const double v : px)
    if (v < 16 || v > kLargestScreen_px || v != std::floor(v))
      yaml.refuse("'screen.px' is not a screen size", "give whole pixels between 16 and 16384");
  ScreenCorners screen{{static_cast<int>(px[0]), static_cast<int>(px[1])},
                       {yaml.vector(node, "lower_left_mm")},
                       {yaml.vector(node, "lower_right_mm")},
                       {yaml.vector(node, "upper_left_mm")}};
  const glm::dvec3 across = screen.across_mm(), up = screen.up_mm();
  const double area = glm::length(glm::cross(across, up));
  if (area < 1.0 || area < 0.99 * glm::length(across) * glm::length(up))
    yaml.refuse("the three screen corners do not span a rectangle", "measure them again");
  return screen;
}

std::optional<Plane<World>> mirrorIn(const CheckedYaml& yaml) {
  const cv::FileNode node = yaml.map(yaml.root(), "mirror"), present = node["present"];
  if (!present.isInt() || static_cast<int>(present) < 0 || static_cast<int>(present) > 1)
    yaml.refuse("'mirror.present' is not 0 or 1", "correct it");
  if (static_cast<int>(present) == 0) return std::nullopt;
  const glm::dvec3 n = yaml.vector(node, "normal");
  const double length = glm::length(n), offset_mm = yaml.number(node, "offset_mm");
  if (length < 1e-6) yaml.refuse("'mirror.normal' is zero", "give the mirror's normal in W");
  // A unit normal is kept to the last bit; otherwise scale normal and offset.
  if (std::abs(length - 1.0) < 1e-12) return Plane<World>{n, offset_mm};
  return Plane<World>{n / length, offset_mm / length};
}

void readEyes(const CheckedYaml& yaml, Rig& rig) {
  const cv::FileNode eyes = yaml.map(yaml.root(), "eyes");
  rig.left_eye = {yaml.vector(eyes, "left_mm")};
  rig.right_eye = {yaml.vector(eyes, "right_mm")};
  if (yaml.has(eyes, "ipd_mm") &&
      std::abs(yaml.number(eyes, "ipd_mm") - glm::distance(rig.left_eye.mm, rig.right_eye.mm)) > 0.05)
    yaml.refuse("'eyes.ipd_mm' is not the distance from left_mm to right_mm", "correct one of them");

  const ScreenCorners seen = virtualScreen(rig);
  const glm::dvec3 corner = seen.lower_left.mm, n = glm::normalize(glm::cross(seen.across_mm(), seen.up_mm()));
  const double left = glm::dot(n, rig.left_eye.mm - corner), right = glm::dot(n, rig.right_eye.mm - corner);
  if (std::abs(left) < 10.0 || std::abs(right) < 10.0 || left * right < 0.0)
    yaml.refuse("an eye lies on the (virtual) screen or the eyes are on both sides of it", "measure them again");
}

RigDevice deviceIn(const CheckedYaml& yaml) {
  const cv::FileNode node = yaml.map(yaml.root(), "device");
  RigDevice device;
  device.model = yaml.text(node, "model");
  if (findPhantomModel(device.model) == nullptr)
    yaml.refuse("'device.model' names no known Phantom", "give one of " + phantomModelKeys());
  if (yaml.has(node, "serial")) device.serial = yaml.text(node, "serial");
  if (yaml.has(node, "mount")) device.mount = yaml.text(node, "mount");
  if (yaml.has(node, "stylus_tip")) device.stylus_tip = yaml.text(node, "stylus_tip");
  return device;
}

void checkSmall(const CheckedYaml& yaml, const char* key, double value, double most, const char* unit) {
  if (std::abs(value) > most)
    yaml.refuse(std::string("'kinematics.") + key + "' is beyond what an arm can be off (" + unit + ")",
                "calibrate again");
}

template <std::size_t n>
std::array<double, n> smallNumbers(const CheckedYaml& yaml, const cv::FileNode& node, const char* key, double most,
                                   const char* unit) {
  std::array<double, n> values{};
  std::ranges::copy(yaml.numbers(node[key], key, n), values.begin());
  for (const double value : values) checkSmall(yaml, key, value, most, unit);
  return values;
}

double smallNumber(const CheckedYaml& yaml, const cv::FileNode& node, const char* key, double most, const char* unit) {
  const double value = yaml.number(node, key);
  checkSmall(yaml, key, value, most, unit);
  return value;
}

/// `total_key` holds base + x for other readers, `exact_key` x itself; one is enough, both must agree.
template <std::size_t n>
std::array<double, n> overBase(const CheckedYaml& yaml, const cv::FileNode& node, const char* total_key,
                               const char* exact_key, const std::array<double, n>& base, double most,
                               const char* unit) {
  std::array<double, n> values{};
  if (yaml.has(node, exact_key)) values = smallNumbers<n>(yaml, node, exact_key, most, unit);
  if (yaml.has(node, exact_key) && !yaml.has(node, total_key)) return values;
  const std::vector<double> total = yaml.numbers(node[total_key], total_key, n);
  for (std::size_t i = 0; i < n; ++i) {
    const double more = total[i] - base[i];
    if (!yaml.has(node, exact_key)) values[i] = more;
    if (std::abs(more - values[i]) > kSameWritten)
      yaml.refuse(std::string("'kinematics.") + total_key + "' and '" + exact_key + "' do not agree", "remove one");
    checkSmall(yaml, total_key, more, most, unit);
  }
  return values;
}

ArmCorrection correctionIn(const CheckedYaml& yaml, const PhantomGeometry& geometry) {
  const cv::FileNode node = yaml.map(yaml.root(), "kinematics");
  if (yaml.text(node, "model") != kKinematicsKind)
    yaml.refuse("'kinematics.model' is not phantom6_v1", "update the program or calibrate again");
  ArmCorrection correction;
  correction.offset_rad = smallNumbers<6>(yaml, node, "m", kMaxOffset_rad, "30 degrees");
  correction.gain = overBase<6>(yaml, node, "k", "gain", {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, kMaxGain, "10 %");
  correction.quadratic_per_rad = smallNumbers<3>(yaml, node, "q", kMaxQuadratic_per_rad, "0.1 a radian");
  const auto more_mm =
      overBase<2>(yaml, node, "l", "more_mm", {geometry.thigh_mm, geometry.shin_mm}, kMaxLength_mm, "20 mm");
  correction.thigh_delta_mm = more_mm[0];
  correction.shin_delta_mm = more_mm[1];
  correction.tilt_rad = smallNumber(yaml, node, "tilt", kMaxTilt_rad, "10 degrees");
  correction.reach_delta_mm = smallNumber(yaml, node, "a1", kMaxLength_mm, "20 mm");
  correction.tip_H_mm = yaml.vector(node, "tip");
  if (glm::length(correction.tip_H_mm) > kMaxTip_mm)
    yaml.refuse("'kinematics.tip' is more than 250 mm from the gimbal", "give the tip in H, in mm");
  return correction;
}

}  // namespace

CheckedYaml::Rigid exactPose(const CheckedYaml& yaml, const cv::FileNode& parent, const std::string& key,
                             double rotation_tolerance) {
  CheckedYaml::Rigid pose = yaml.rigid(parent, key, rotation_tolerance);
  const std::string exact_key = key + "_wxyz";
  if (!yaml.has(parent, exact_key)) return pose;
  const std::vector<double> q = yaml.numbers(parent[exact_key], exact_key, 4);
  const glm::dquat exact(q[0], q[1], q[2], q[3]);
  // q and -q are the same rotation.
  if (std::abs(glm::dot(exact, exact) - 1.0) > kSameWritten ||
      std::abs(std::abs(glm::dot(exact, pose.rotation)) - 1.0) > kSameWritten)
    yaml.refuse("'" + exact_key + "' is not the rotation of '" + key + "'", "remove '" + exact_key + "'");
  pose.rotation = exact;
  return pose;
}

Rig rigIn(const CheckedYaml& yaml, double rotation_tolerance) {
  Rig rig;
  rig.screen = screenIn(yaml);
  rig.mirror = mirrorIn(yaml);
  readEyes(yaml, rig);
  rig.X_WP = poseIn<World, Patient>(yaml, "X_WP", rotation_tolerance);
  rig.X_WD = poseIn<World, Device>(yaml, "X_WD", rotation_tolerance);
  if (yaml.has(yaml.root(), "X_WD2")) rig.second_X_WD = poseIn<World, Device>(yaml, "X_WD2", rotation_tolerance);
  if (yaml.has(yaml.root(), "device")) rig.device = deviceIn(yaml);
  if (yaml.has(yaml.root(), "kinematics")) {
    if (!rig.device) yaml.refuse("'kinematics' without 'device'", "name its device");
    rig.arm = correctionIn(yaml, findPhantomModel(rig.device->model)->geometry);
  }
  return rig;
}

}  // namespace calibration
