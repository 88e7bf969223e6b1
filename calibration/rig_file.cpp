#include "calibration/rig_file.h"

#include <cmath>
#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace calibration {
namespace {

constexpr std::uintmax_t kLargestFile_bytes = 1 << 20;
constexpr double kRotationTolerance = 1e-3;
constexpr double kLargestCoordinate_mm = 1e5;
constexpr int kLargestScreen_px = 16384;

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& mend) {
  throw CalibrationError("rig file " + path + ": " + what + ", " + mend);
}

/// One rig file while it is being read: every answer is checked, every refusal names the key.
class RigReader {
 public:
  RigReader(const std::string& path, const cv::FileStorage& file) : path_(path), root_(file.root()) {}

  std::vector<double> numbers(const cv::FileNode& node, const std::string& key, std::size_t count) const {
    if (node.empty()) refuse(path_, "'" + key + "' is missing", "add it (README, rig file)");
    if (!node.isSeq() || node.size() != count)
      refuse(path_, "'" + key + "' is not a list of " + std::to_string(count) + " numbers", "correct it");
    std::vector<double> values;
    for (const cv::FileNode& item : node) {
      if (!item.isInt() && !item.isReal()) refuse(path_, "'" + key + "' holds something not a number", "correct it");
      values.push_back(item.real());
    }
    for (const double v : values)
      if (!std::isfinite(v) || std::abs(v) > kLargestCoordinate_mm)
        refuse(path_, "'" + key + "' holds a number that is not finite or beyond 100 m", "give mm in frame W");
    return values;
  }

  glm::dvec3 vector(const cv::FileNode& parent, const char* key) const {
    const auto v = numbers(parent[key], key, 3);
    return {v[0], v[1], v[2]};
  }

  cv::FileNode map(const char* key) const {
    const cv::FileNode node = root_[key];
    if (!node.isMap()) refuse(path_, std::string("block '") + key + "' is missing", "add it (README, rig file)");
    return node;
  }

  template <class A, class B>
  Pose<A, B> pose(const char* key) const {
    // Row-major m[4 r + c].
    const std::vector<double> m = sixteenNumbers(root_[key], key);
    glm::dmat3 R{1.0};
    glm::dvec3 p{0.0};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) R[c][r] = m[4 * r + c];
      p[r] = m[4 * r + 3];
    }
    // A pose is rigid: orthonormal, determinant +1, last row 0 0 0 1.
    const glm::dmat3 gram = glm::transpose(R) * R;
    double error = std::abs(m[15] - 1.0);
    for (int c = 0; c < 3; ++c) {
      error = std::max(error, std::abs(m[12 + c]));
      for (int r = 0; r < 3; ++r) error = std::max(error, std::abs(gram[c][r] - (r == c ? 1.0 : 0.0)));
    }
    const bool finite = std::isfinite(error) && std::isfinite(glm::dot(p, p));
    if (!finite || error > kRotationTolerance || glm::determinant(R) < 0.0)
      refuse(path_, std::string("'") + key + "' is not a rigid pose with determinant +1",
             "correct the matrix (no scale, no flip: the mirror is in 'mirror')");
    return {glm::normalize(glm::quat_cast(R)), p};
  }

  /// A 4x4 matrix as OpenCV writes it, or by hand: 16 numbers, or four rows of four. The sizes a file declares are
  /// compared, never allocated.
  std::vector<double> sixteenNumbers(const cv::FileNode& node, const char* key) const {
    const auto declares = [&](const char* side) { return node[side].isInt() && static_cast<int>(node[side]) == 4; };
    if (node.isMap() && declares("rows") && declares("cols")) return numbers(node["data"], key, 16);
    if (node.isSeq() && node.size() == 16) return numbers(node, key, 16);
    std::vector<double> values;
    if (node.isSeq() && node.size() == 4)
      for (const cv::FileNode& row : node)
        for (const double v : numbers(row, key, 4)) values.push_back(v);
    if (values.size() != 16)
      refuse(path_, std::string("'") + key + "' is not a 4x4 matrix", "write it as !!opencv-matrix, row-major, mm");
    return values;
  }

  void checkKind() const {
    const cv::FileNode schema = root_["schema"], kind = root_["kind"];
    if (!kind.isString() || kind.string() != "molar_rig")
      refuse(path_, "it is not a rig file (kind: \"molar_rig\" missing)", "give the file that calibration wrote");
    if (!schema.isInt() || static_cast<int>(schema) != 1)
      refuse(path_, "its schema is not 1", "update the program or the file");
  }

  ScreenCorners screen() const {
    const cv::FileNode node = map("screen");
    const auto px = numbers(node["px"], "px", 2);
    for (const double v : px)
      if (v < 16 || v > kLargestScreen_px || v != std::floor(v))
        refuse(path_, "'screen.px' is not a screen size", "give whole pixels between 16 and 16384");
    ScreenCorners screen{{static_cast<int>(px[0]), static_cast<int>(px[1])},
                         {vector(node, "lower_left_mm")},
                         {vector(node, "lower_right_mm")},
                         {vector(node, "upper_left_mm")}};
    const glm::dvec3 across = screen.lower_right.mm - screen.lower_left.mm;
    const glm::dvec3 up = screen.upper_left.mm - screen.lower_left.mm;
    const double area = glm::length(glm::cross(across, up));
    if (area < 1.0 || area < 0.99 * glm::length(across) * glm::length(up))
      refuse(path_, "the three screen corners do not span a rectangle", "measure them again");
    return screen;
  }

  std::optional<Plane<World>> mirror() const {
    const cv::FileNode node = map("mirror"), present = node["present"];
    if (!present.isInt() || static_cast<int>(present) < 0 || static_cast<int>(present) > 1)
      refuse(path_, "'mirror.present' is not 0 or 1", "correct it");
    if (static_cast<int>(present) == 0) return std::nullopt;
    const glm::dvec3 n = vector(node, "normal");
    const cv::FileNode offset = node["offset_mm"];
    if (glm::length(n) < 1e-6) refuse(path_, "'mirror.normal' is zero", "give the mirror's normal in W");
    if ((!offset.isInt() && !offset.isReal()) || !(std::abs(offset.real()) <= kLargestCoordinate_mm))
      refuse(path_, "'mirror.offset_mm' is not a distance", "give n.x in mm");
    // n.x = offset as written: scale both.
    return Plane<World>{glm::normalize(n), offset.real() / glm::length(n)};
  }

  Rig rig() const {
    checkKind();
    const cv::FileNode eyes = map("eyes");
    Rig rig;
    rig.screen = screen();
    rig.mirror = mirror();
    rig.left_eye = {vector(eyes, "left_mm")};
    rig.right_eye = {vector(eyes, "right_mm")};
    rig.X_WP = pose<World, Patient>("X_WP");
    rig.X_WD = pose<World, Device>("X_WD");
    if (!root_["X_WD2"].empty()) rig.second_X_WD = pose<World, Device>("X_WD2");
    checkEyes(rig);
    return rig;
  }

 private:
  void checkEyes(const Rig& rig) const {
    Point<World> ll = rig.screen.lower_left, lr = rig.screen.lower_right, ul = rig.screen.upper_left;
    if (rig.mirror) ll = rig.mirror->reflect(ll), lr = rig.mirror->reflect(lr), ul = rig.mirror->reflect(ul);
    const glm::dvec3 n = glm::normalize(glm::cross(lr.mm - ll.mm, ul.mm - ll.mm));
    const double left = glm::dot(n, rig.left_eye.mm - ll.mm), right = glm::dot(n, rig.right_eye.mm - ll.mm);
    if (std::abs(left) < 10.0 || std::abs(right) < 10.0 || left * right < 0.0)
      refuse(path_, "an eye lies on the (virtual) screen or the eyes are on both sides of it", "measure them again");
  }

  const std::string& path_;
  cv::FileNode root_;
};

}  // namespace

Rig readRig(const std::string& path) {
  // OpenCV explains itself on stderr; the one line of this program says it instead.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (error || !std::filesystem::is_regular_file(path))
    refuse(path, "it can not be read", "check the path and its permissions");
  if (bytes == 0 || bytes > kLargestFile_bytes) refuse(path, "its size is not that of a rig file", "check the path");
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ | cv::FileStorage::FORMAT_YAML);
    if (!file.isOpened()) refuse(path, "it can not be opened", "check its permissions");
    return RigReader(path, file).rig();
  } catch (const cv::Exception&) {
    refuse(path, "it is not OpenCV FileStorage YAML", "give the file that calibration wrote");
  }
}

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
