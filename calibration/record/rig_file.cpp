#include "calibration/record/rig_file.h"

#include <cmath>

#include <opencv2/core.hpp>

#include "calibration/checked_yaml.h"

namespace calibration {
namespace {

constexpr int kSchema = 1;
constexpr int kLargestScreen_px = 16384;

template <class A, class B>
Pose<A, B> poseIn(const CheckedYaml& yaml, const char* key) {
  const CheckedYaml::Rigid rigid = yaml.rigid(yaml.root(), key);
  return {rigid.rotation, rigid.translation_mm};
}

void checkKind(const CheckedYaml& yaml) {
  const cv::FileNode kind = yaml.root()["kind"];
  if (!kind.isString() || kind.string() != "molar_rig")
    yaml.refuse("it is not a rig file (kind: \"molar_rig\" missing)", "give the file that calibration wrote");
  const cv::FileNode schema = yaml.root()["schema"];
  if (!schema.isInt() || static_cast<int>(schema) != kSchema)
    yaml.refuse("its schema is not 1", "update the program or the file");
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
  const glm::dvec3 across = screen.lower_right.mm - screen.lower_left.mm;
  const glm::dvec3 up = screen.upper_left.mm - screen.lower_left.mm;
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
  if (glm::length(n) < 1e-6) yaml.refuse("'mirror.normal' is zero", "give the mirror's normal in W");
  // n.x = offset as written: scale both.
  return Plane<World>{glm::normalize(n), yaml.number(node, "offset_mm") / glm::length(n)};
}

void checkEyes(const CheckedYaml& yaml, const Rig& rig) {
  Point<World> ll = rig.screen.lower_left, lr = rig.screen.lower_right, ul = rig.screen.upper_left;
  if (rig.mirror) ll = rig.mirror->reflect(ll), lr = rig.mirror->reflect(lr), ul = rig.mirror->reflect(ul);
  const glm::dvec3 n = glm::normalize(glm::cross(lr.mm - ll.mm, ul.mm - ll.mm));
  const double left = glm::dot(n, rig.left_eye.mm - ll.mm), right = glm::dot(n, rig.right_eye.mm - ll.mm);
  if (std::abs(left) < 10.0 || std::abs(right) < 10.0 || left * right < 0.0)
    yaml.refuse("an eye lies on the (virtual) screen or the eyes are on both sides of it", "measure them again");
}

Rig rigIn(const CheckedYaml& yaml) {
  checkKind(yaml);
  const cv::FileNode eyes = yaml.map(yaml.root(), "eyes");
  Rig rig;
  rig.screen = screenIn(yaml);
  rig.mirror = mirrorIn(yaml);
  rig.left_eye = {yaml.vector(eyes, "left_mm")};
  rig.right_eye = {yaml.vector(eyes, "right_mm")};
  rig.X_WP = poseIn<World, Patient>(yaml, "X_WP");
  rig.X_WD = poseIn<World, Device>(yaml, "X_WD");
  if (yaml.has(yaml.root(), "X_WD2")) rig.second_X_WD = poseIn<World, Device>(yaml, "X_WD2");
  checkEyes(yaml, rig);
  return rig;
}

}  // namespace

RigRecord readRigRecord(const std::string& path) {
  RigRecord record;
  record.rig = rigIn(CheckedYaml("rig file", path));
  return record;
}

Rig readRig(const std::string& path) { return readRigRecord(path).rig; }

std::string rigText(const Rig& rig) {
  cv::FileStorage out("rig.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  const auto list = [&](const char* key, const glm::dvec3& v) { out << key << "[:" << v.x << v.y << v.z << "]"; };
  const auto matrix = [&](const char* key, const glm::dmat4& m) {
    cv::Mat rows(4, 4, CV_64F);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) rows.at<double>(r, c) = m[c][r];
    out << key << rows;
  };
  out << "schema" << 1 << "kind"
      << "molar_rig";
  out << "screen"
      << "{";
  out << "px"
      << "[:" << rig.screen.px.x << rig.screen.px.y << "]";
  list("lower_left_mm", rig.screen.lower_left.mm);
  list("lower_right_mm", rig.screen.lower_right.mm);
  list("upper_left_mm", rig.screen.upper_left.mm);
  out << "}";
  out << "mirror"
      << "{"
      << "present" << (rig.mirror ? 1 : 0);
  list("normal", rig.mirror ? rig.mirror->normal : glm::dvec3(0, 1, 0));
  out << "offset_mm" << (rig.mirror ? rig.mirror->offset_mm : 0.0) << "}";
  out << "eyes"
      << "{";
  list("left_mm", rig.left_eye.mm);
  list("right_mm", rig.right_eye.mm);
  out << "}";
  matrix("X_WP", rig.X_WP.matrix());
  matrix("X_WD", rig.X_WD.matrix());
  if (rig.second_X_WD) matrix("X_WD2", rig.second_X_WD->matrix());
  return out.releaseAndGetString();
}

}  // namespace calibration
