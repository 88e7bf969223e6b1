#include "calibration/fit/rezero.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "calibration/fit/arm_problem.h"
#include "calibration/fit/kinematic_fit.h"
#include "calibration/fit/touch_checks.h"
#include "calibration/geometry/rotation.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

/// Model error left by a good calibration, an axis.
constexpr double kLeft_mm = 0.15;
/// An outlier: this far from the prediction of the others, and so many times their own RMS.
constexpr double kStrayPit_mm = 1.8, kStrayPitTimes = 4.0;
constexpr std::size_t kMinPits = 3;
constexpr double kNarrowPits_mm = 5.0;  ///< targets nearer to a line leave the rotation about it undetermined

/// Rotation about the targets' centre, translation, offsets of the three joints, under their priors: homing is rarely
/// off by more than a degree; the pose has no prior.
constexpr std::array<std::size_t, 9> kRezeroNumbers = {0, 1, 2, 3, 4, 5, 9, 10, 11};

using Touches = std::vector<Touch>;
using Indices = std::vector<std::size_t>;

[[noreturn]] void refuseRezero(const std::string& what) { throw CalibrationError("re-zero: " + what); }

/// Largest distance of a target from the line through the two farthest targets.
double width_mm(const Touches& touches) {
  glm::dvec3 from{0.0}, line{0.0};
  for (const Touch& a : touches)
    for (const Touch& b : touches)
      if (glm::length((b.target_W - a.target_W).xyz) > glm::length(line)) {
        from = a.target_W.mm;
        line = (b.target_W - a.target_W).xyz;
      }
  const double length_mm = glm::length(line);
  double width = 0.0;
  for (const Touch& touch : touches)
    if (length_mm > 0.0) width = std::max(width, glm::length(glm::cross(touch.target_W.mm - from, line)) / length_mm);
  return width;
}

void check(const Touches& touches) {
  if (touches.size() < kMinPits)
    refuseRezero(std::to_string(touches.size()) + " touches, at least 3 are needed: touch the 5 pits shown");
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const std::string name = "touch " + std::to_string(touches[i].id);
    if (!isFinite(touches[i])) refuseRezero(name + " has a value that is not finite: touch that pit again");
    for (std::size_t k = 0; k < i; ++k)
      if (touches[k].joints_rad == touches[i].joints_rad)
        refuseRezero(name + " is the same as touch " + std::to_string(touches[k].id) + ": touch each pit once");
  }
  if (width_mm(touches) < kNarrowPits_mm)
    refuseRezero("the touches lie on a line: touch pits that are spread to all sides");
}

glm::dvec3 middleOf_mm(const Touches& touches) {
  glm::dvec3 sum{0.0};
  for (const Touch& touch : touches) sum += touch.target_W.mm;
  return sum / static_cast<double>(touches.size());
}

MeasuredArm fitted(const MeasuredArm& arm, const Touches& touches, const Indices& which,
                   const TouchPrecision& precision) {
  const ArmStart start{arm.geometry, arm.X_WD, {middleOf_mm(touches)}, arm.correction};
  ArmProblem problem(start, touches, which, kRezeroNumbers, 0.0);
  return armOf(start, problem.all(problem.solvedFrom({}, touchSigma_mm(precision, kLeft_mm)).parameters));
}

/// The touches that agree; outliers are removed one by one, the worst first. Each is predicted from the others alone,
/// because so few points can absorb an outlier by turning the base.
Indices agreeing(const MeasuredArm& arm, const Touches& touches, const TouchPrecision& precision) {
  Indices which(touches.size());
  std::iota(which.begin(), which.end(), std::size_t{0});
  const double min_mm = std::hypot(kStrayPit_mm, 3.0 * std::hypot(precision.in_plane_mm, precision.along_sight_mm));
  // At least four touches must agree.
  for (std::size_t rounds = (touches.size() - kMinPits) / 2; rounds > 0; --rounds) {
    Indices best = which;
    double best_rms_mm = rms_mm(fitted(arm, touches, which, precision), touches, which);
    for (const std::size_t i : which) {
      Indices others = which;
      std::erase(others, i);
      const MeasuredArm by_others = fitted(arm, touches, others, precision);
      const double rest_mm = rms_mm(by_others, touches, others);
      const double off_mm = rms_mm(by_others, touches, std::array{i});
      if (rest_mm < best_rms_mm && off_mm > std::max(min_mm, kStrayPitTimes * rest_mm)) {
        best_rms_mm = rest_mm;
        best = std::move(others);
      }
    }
    if (best == which) break;
    which = std::move(best);
  }
  return which;
}

}  // namespace

Rezero rezeroed(const MeasuredArm& arm, const TouchSet& set) {
  Touches touches;
  for (const Touch& touch : set.touches)
    if (touch.used) touches.push_back(touch);
  check(touches);

  const Indices which = agreeing(arm, touches, set.precision);
  Rezero result;
  result.arm = fitted(arm, touches, which, set.precision);
  result.before_rms_mm = rms_mm(arm, touches, which);
  result.after_rms_mm = rms_mm(result.arm, touches, which);
  result.outliers = static_cast<int>(touches.size() - which.size());

  result.residuals = residualsOf(result.arm, set.touches);
  std::size_t next = 0;
  for (Residual& residual : result.residuals)
    residual.used = residual.used && std::ranges::binary_search(which, next++);

  result.turned_deg = degreesFromRad(angleBetween_rad(arm.X_WD.rotation, result.arm.X_WD.rotation));
  result.moved_mm = glm::distance(result.arm.X_WD.translation_mm, arm.X_WD.translation_mm);
  for (std::size_t i = 0; i < 3; ++i)
    result.offset_change_deg[i] = degreesFromRad(result.arm.correction.offset_rad[i] - arm.correction.offset_rad[i]);
  return result;
}

}  // namespace calibration
