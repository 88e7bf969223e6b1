#include "calibration/fit/cross_validation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/fit/least_squares.h"

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t kFolds = 5, kFewPlaces = 20;
constexpr double kSamePlace_mm = 1.0;

/// The fold of each touch: places are dealt in the order they were touched in, those of touches that do not count too,
/// so that one wild touch does not deal the others anew.
struct Folds {
  Indices of_touch;
  std::size_t count = kFolds;

  explicit Folds(const std::vector<Touch>& touches) {
    std::vector<glm::dvec3> places;
    for (const Touch& touch : touches) {
      const glm::dvec3& here = touch.target_W.mm;
      const auto known =
          std::ranges::find_if(places, [&](const glm::dvec3& p) { return glm::distance(p, here) < kSamePlace_mm; });
      of_touch.push_back(static_cast<std::size_t>(known - places.begin()));
      if (known == places.end()) places.push_back(here);
    }
    if (places.size() < kFewPlaces) count = places.size();
    for (std::size_t& fold : of_touch) fold %= count;
  }
};

/// The mean over all touches of `errors_mm2(seen, asked)`: sums of squares, an axis, over those asked by what was seen.
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

struct Affine {
  std::array<glm::dvec4, 3> rows{};  ///< of x, y, z: three factors and a constant

  glm::dvec3 operator()(const glm::dvec3& p) const {
    const glm::dvec4 h(p, 1.0);
    return {glm::dot(rows[0], h), glm::dot(rows[1], h), glm::dot(rows[2], h)};
  }
};

/// Nominal tips, in W by the start so that the numbers are of one size.
glm::dvec3 nominalTip_mm(const ArmStart& start, const Touch& touch) {
  return armOf(start, {}).tip_W(touch.joints_rad).mm - start.middle_W.mm;
}

std::optional<Affine> affineFit(const ArmStart& start, const std::vector<Touch>& touches,
                                std::span<const std::size_t> which) {
  if (which.size() < 5) return std::nullopt;
  std::array<double, 16> normal{};
  std::array<std::array<double, 4>, 3> right{};
  for (const std::size_t i : which) {
    const glm::dvec4 h(nominalTip_mm(start, touches[i]), 1.0);
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) normal[static_cast<std::size_t>(4 * r + c)] += h[r] * h[c];
      for (int axis = 0; axis < 3; ++axis)
        right[static_cast<std::size_t>(axis)][static_cast<std::size_t>(r)] += h[r] * touches[i].target_W.mm[axis];
    }
  }
  // Flat to within half a millimetre: nothing is known across.
  if (!choleskyFactored(normal, 4)) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k)
    if (normal[5 * k] < 0.5 * std::sqrt(static_cast<double>(which.size()))) return std::nullopt;
  Affine affine;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    choleskySolved(normal, 4, right[axis]);
    affine.rows[axis] = {right[axis][0], right[axis][1], right[axis][2], right[axis][3]};
  }
  return affine;
}

}  // namespace

CrossValidation crossValidated(const ArmStart& start, const std::vector<Touch>& touches,
                               std::span<const std::size_t> which, const TouchPrecision& precision,
                               const KinematicFit& whole) {
  const glm::dvec3 squares = overFolds_mm2(touches, which, [&](const Indices& seen, const Indices& asked) {
    const MeasuredArm arm = armOf(start, kinematicFit(start, touches, seen, precision, whole.fitted, &whole).numbers);
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
      const glm::dvec3 error = (*affine)(nominalTip_mm(start, touches[i])) - touches[i].target_W.mm;
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
