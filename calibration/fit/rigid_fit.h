// Rigid registration of point sets, optionally mirrored, and its robust version: the largest set that agrees on one
// map. The first outlier test on touches, before any arm is fitted. Deterministic: all sets of four, or the same four
// hundred. mm. Any thread but the servo's; about 2 ms for 64 points. Sources: Umeyama 1991; reference/calibration 3.1,
// 3.3 (OpenCV's robust fit does not refit its inliers).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace calibration {

/// p -> rotation p + translation. Determinant -1: mirrored.
struct RigidMap {
  glm::dmat3 rotation{1.0};
  glm::dvec3 translation_mm{0.0};

  glm::dvec3 operator()(const glm::dvec3& p_mm) const { return rotation * p_mm + translation_mm; }
};

enum class Handedness { kept, mirrored };

struct PointPair {
  glm::dvec3 to_mm{0.0}, from_mm{0.0};
  double weight = 1.0;
};

/// Weighted least squares. None: fewer than three, or all on a line.
std::optional<RigidMap> rigidFit(std::span<const PointPair> pairs, Handedness handedness = Handedness::kept);

struct RigidAgreement {
  RigidMap map;
  std::vector<std::size_t> agreeing;  ///< ascending
  double limit_mm = 0.0;              ///< of agreement
  double rms_mm = 0.0;                ///< of the agreeing ones
};

/// The largest set within a limit of one map: the limit grows from `min_limit_mm` until two thirds agree, and is
/// finally at least three times their RMS. None: not up to `max_limit_mm`.
std::optional<RigidAgreement> rigidAgreement(std::span<const glm::dvec3> from_mm, std::span<const glm::dvec3> to_mm,
                                             Handedness handedness, double min_limit_mm, double max_limit_mm);

}  // namespace calibration
