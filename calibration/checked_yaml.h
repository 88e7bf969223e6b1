// Checked reading of OpenCV FileStorage YAML: every access is checked, and every error is one line with file, key and
// remedy. Declared sizes are compared, never allocated; OpenCV prints nothing to stderr. For rig files, observations,
// cameras. mm, rad. Start-up only; one thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "calibration/calibration_error.h"

namespace cv {
class FileNode;
}

namespace calibration {

class CheckedYaml {
 public:
  /// `kind`: what the file should be, for messages: "rig file". Throws CalibrationError: missing, empty, beyond 4 MiB,
  /// truncated, not YAML, lists nested more than 64 deep (OpenCV's parser is recursive).
  CheckedYaml(std::string kind, std::string path);
  ~CheckedYaml();
  CheckedYaml(const CheckedYaml&) = delete;
  CheckedYaml& operator=(const CheckedYaml&) = delete;

  [[noreturn]] void refuse(const std::string& what, const std::string& mend) const;

  /// Whether the file's `kind:` is this one; checkKind throws otherwise, and for a schema other than 1.
  bool isKind(std::string_view kind) const;
  void checkKind(std::string_view kind) const;

  const std::string& bytes() const;  ///< as read
  cv::FileNode root() const;
  /// A map that must exist.
  cv::FileNode map(const cv::FileNode& parent, const std::string& key) const;
  bool has(const cv::FileNode& parent, const std::string& key) const;

  /// The largest magnitude of a number, and how messages call it.
  struct Limit {
    double most;
    const char *name, *mend;
  };
  static constexpr Limit kLargest{1e5, "100 m", "give mm in frame W"};
  /// Finite and within the limit.
  double number(const cv::FileNode& parent, const std::string& key) const;
  std::vector<double> numbers(const cv::FileNode& list, const std::string& key, std::size_t count,
                              const Limit& limit = kLargest) const;
  glm::dvec3 vector(const cv::FileNode& parent, const std::string& key) const;
  /// `where`: a prefix of the key in messages.
  int integer(const cv::FileNode& parent, const std::string& key, int least, int most,
              const std::string& where = {}) const;
  /// Printable, at most 200 bytes.
  std::string text(const cv::FileNode& parent, const std::string& key) const;

  struct Rigid {
    glm::dquat rotation;
    glm::dvec3 translation_mm;
  };
  /// A 4x4 matrix as OpenCV writes it, or 16 numbers, or four rows of four. Orthonormal, determinant +1.
  Rigid rigid(const cv::FileNode& parent, const std::string& key, double tolerance = 1e-3) const;

 private:
  std::vector<double> sixteenNumbers(const cv::FileNode& node, const std::string& key) const;

  struct Storage;
  std::string kind_, path_;
  std::unique_ptr<Storage> storage_;
};

/// "4.6.0".
std::string openCvVersion();

}  // namespace calibration
