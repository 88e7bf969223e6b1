// One set of places laid onto another, turned and moved but not scaled, and the same in a mirror; and which of them
// agree on one such lay: the first look at touches, before any arm is fitted. Deterministic: where not every four can
// be tried, the same four hundred are. Plain places, mm. Any thread but the servo's; about 2 ms for 64 places. Sources:
// Umeyama 1991; reference/calibration 3.1, 3.3 (OpenCV's robust fit does not refit on what agrees).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace calibration {

/// p -> turn p + shift. Determinant -1: a mirror.
struct RigidMap {
  glm::dmat3 turn{1.0};
  glm::dvec3 shift_mm{0.0};

  glm::dvec3 operator()(const glm::dvec3& p_mm) const { return turn * p_mm + shift_mm; }
};

enum class Handedness { kept, mirrored };

struct PointPair {
  glm::dvec3 to_mm{0.0}, from_mm{0.0};
  double weight = 1.0;
};

/// Least squares, each pair by its weight. None: fewer than three, or all on a line.
std::optional<RigidMap> rigidFit(std::span<const PointPair> pairs, Handedness handedness = Handedness::kept);

struct RigidAgreement {
  RigidMap map;
  std::vector<std::size_t> agreeing;  ///< rising
  double limit_mm = 0.0;              ///< within which they agree
  double rms_mm = 0.0;                ///< of those agreeing
};

/// The most that lie within a limit of one map: the limit grows from `least_limit_mm` until two thirds agree, and is
/// at last at least three times their RMS. None: not by `most_limit_mm`.
std::optional<RigidAgreement> rigidAgreement(std::span<const glm::dvec3> from_mm, std::span<const glm::dvec3> to_mm,
                                             Handedness handedness, double least_limit_mm, double most_limit_mm);

}  // namespace calibration
