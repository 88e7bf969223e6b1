#include "calibration/fit/cross_validation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/gtc/type_ptr.hpp>

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t kFolds = 5, kFewPlaces = 20;
constexpr double kSamePlace_mm = 1.0;

/// The fold of each touch. Positions are dealt in touching order, rejected touches included, so that one outlier does
/// not change the folds of the others.
struct Folds {
  Indices of_touch;
  std::size_t count = kFolds;

  explicit Folds(const std::vector<Touch>& touches) {
    std::vector<glm::dvec3> positions;
    for (const Touch& touch : touches) {
      const glm::dvec3& here = touch.target_W.mm;
      const auto known =
          std::ranges::find_if(positions, [&](const glm::dvec3& p) { return glm::distance(p, here) < kSamePlace_mm; });
      of_touch.push_back(static_cast<std::size_t>(known - positions.begin()));
      if (known == positions.end()) positions.push_back(here);
    }
    if (positions.size() < kFewPlaces) count = positions.size();
    for (std::size_t& fold : of_touch) fold %= count;
  }
};

/// Mean over all touches of `errors_mm2(seen, asked)`: sums of squares per axis over `asked`, predicted from `seen`.
template <class Errors>
glm::dvec3 overFolds_mm2(const std::vector<Touch>& touches, std::span<const std::size_t> which, Errors errors_mm2) {
  const Folds folds(touches);
  glm::dvec3 sum{0.0};
  for (std::size_t fold = 0; fold < folds.count; ++fold) {
    Indices seen, asked;
    for (const std::size_t i : which) (folds.of_touch[i] == fold ? asked : seen).push_back(i);
    if (!asked.empty()) sum += errors_mm2(seen, asked);
  }
  return sum / static_cast<double>(which.size());
}

double rootOfSum(const glm::dvec3& squares) { return std::sqrt(squares.x + squares.y + squares.z); }

/// Nominal tips in W about the centre, so that the parameters have similar scale.
glm::dvec3 nominalTip_mm(const ArmStart& start, const Touch& touch) {
  return armOf(start, {}).tip_W(touch.joints_rad).mm - start.middle_W.mm;
}

/// Maps a homogeneous nominal tip to p_W.
std::optional<glm::dmat4x3> affineFit(const ArmStart& start, const std::vector<Touch>& touches,
                                      std::span<const std::size_t> which) {
  if (which.size() < 5) return std::nullopt;
  glm::dmat4 normal(0.0);
  glm::dmat4x3 right(0.0);
  for (const std::size_t i : which) {
    const glm::dvec4 h(nominalTip_mm(start, touches[i]), 1.0);
    normal += glm::outerProduct(h, h);
    right += glm::outerProduct(touches[i].target_W.mm, h);
  }
  // Flat within half a millimetre: undetermined across the plane.
  const Eigen::LLT<Eigen::Matrix4d> factor(Eigen::Matrix4d::Map(glm::value_ptr(normal)));
  const double least = 0.5 * std::sqrt(static_cast<double>(which.size()));
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().head<3>().minCoeff() < least)
    return std::nullopt;
  using Right = Eigen::Matrix<double, 3, 4>;
  glm::dmat4x3 affine;
  Right::Map(glm::value_ptr(affine)) = factor.solve(Right::Map(glm::value_ptr(right)).transpose()).transpose();
  return affine;
}

}  // namespace

CrossValidation crossValidated(const ArmStart& start, const std::vector<Touch>& touches,
                               std::span<const std::size_t> which, const TouchPrecision& precision,
                               const KinematicFit& whole) {
  const glm::dvec3 squares = overFolds_mm2(touches, which, [&](const Indices& seen, const Indices& asked) {
    const MeasuredArm arm =
        armOf(start, kinematicFit(start, touches, seen, precision, whole.fitted, &whole).parameters);
    glm::dvec3 sum{0.0};
    for (const std::size_t i : asked) {
      const glm::dvec3 error = arm.tip_W(touches[i].joints_rad).mm - touches[i].target_W.mm;
      sum += error * error;
    }
    return sum;
  });
  const glm::dvec3 sigma_mm = touchSigma_mm(precision, kUsualMismatch_mm);
  return {rootOfSum(squares), rootOfSum(squares / (sigma_mm * sigma_mm))};
}

std::optional<AffineScore> affineScore(const ArmStart& start, const std::vector<Touch>& touches,
                                       std::span<const std::size_t> which) {
  bool possible = true;
  const auto errors_mm2 = [&](std::span<const std::size_t> seen, std::span<const std::size_t> asked) {
    const auto affine = affineFit(start, touches, seen);
    possible = possible && affine;
    glm::dvec3 sum{0.0};
    for (const std::size_t i : asked) {
      if (!affine) break;
      const glm::dvec3 error = *affine * glm::dvec4(nominalTip_mm(start, touches[i]), 1.0) - touches[i].target_W.mm;
      sum += error * error;
    }
    return sum;
  };
  AffineScore score;
  score.fre_rms_mm = rootOfSum(errors_mm2(which, which) / static_cast<double>(which.size()));
  score.cv_rms_mm = rootOfSum(overFolds_mm2(touches, which, errors_mm2));
  return possible ? std::optional(score) : std::nullopt;
}

}  // namespace calibration
