// A YAML file of OpenCV's FileStorage while it is being read: every answer is checked, every refusal is one line that
// names the file, the key and the remedy. The sizes a file declares are compared, never allocated. OpenCV's own words
// are kept off stderr. For rig files, observations, cameras. mm, rad. Start-up only; one thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
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
  /// `kind`: what it should be, for refusals: "rig file". Throws CalibrationError: not there, empty, beyond 4 MiB,
  /// truncated, not YAML, lists in lists more than 64 deep (OpenCV's parser recurses).
  CheckedYaml(std::string kind, std::string path);
  ~CheckedYaml();
  CheckedYaml(const CheckedYaml&) = delete;
  CheckedYaml& operator=(const CheckedYaml&) = delete;

  [[noreturn]] void refuse(const std::string& what, const std::string& mend) const;

  const std::string& bytes() const;  ///< as read
  cv::FileNode root() const;
  /// A map that must be there.
  cv::FileNode map(const cv::FileNode& parent, const std::string& key) const;
  bool has(const cv::FileNode& parent, const std::string& key) const;

  /// Finite and within ±1e5.
  double number(const cv::FileNode& parent, const std::string& key) const;
  std::vector<double> numbers(const cv::FileNode& list, const std::string& key, std::size_t count) const;
  glm::dvec3 vector(const cv::FileNode& parent, const std::string& key) const;
  int integer(const cv::FileNode& parent, const std::string& key, int least, int most) const;
  /// Printable, at most 200 bytes.
  std::string text(const cv::FileNode& parent, const std::string& key) const;

  struct Rigid {
    glm::dquat rotation;
    glm::dvec3 translation_mm;
  };
  /// A 4x4 matrix as OpenCV writes it, or by hand: 16 numbers, or four rows of four. Orthonormal, determinant +1.
  Rigid rigid(const cv::FileNode& parent, const std::string& key, double tolerance = 1e-3) const;

 private:
  std::vector<double> sixteenNumbers(const cv::FileNode& node, const std::string& key) const;

  struct Storage;
  std::string kind_, path_;
  std::unique_ptr<Storage> storage_;
};

/// "4.6.0": of the library whose solvers and files these are.
std::string openCvVersion();

}  // namespace calibration
