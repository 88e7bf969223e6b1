#include "calibration/fit/rezero.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/kinematic_fit.h"
#include "calibration/fit/least_squares.h"
#include "calibration/geometry/turn.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

/// What a good calibration leaves at a touch, an axis: no touch is trusted further than that.
constexpr double kLeft_mm = 0.15;
/// A homing is rarely off by more; of the pose nothing is believed beforehand.
constexpr double kHomingSigma_deg = 1.0;
/// A touch that the others contradict by more than this, and by so many times what they differ among themselves.
constexpr double kStrayPit_mm = 1.8, kStrayPitTimes = 4.0;
constexpr std::size_t kFewestPits = 3;
constexpr double kNarrowPits_mm = 5.0;  ///< targets this near to a line say nothing of the turn about it

/// Turn about the targets' middle, shift, offsets of the three joints.
constexpr std::size_t kRezeroNumbers = 9;

using Touches = std::vector<Touch>;

[[noreturn]] void refuseRezero(const std::string& what) { throw CalibrationError("re-zero: " + what); }

bool finite(const Touch& touch) {
  double sum = touch.target_W.mm.x + touch.target_W.mm.y + touch.target_W.mm.z;
  for (const double angle_rad : touch.joints_rad) sum += angle_rad;
  return std::isfinite(sum);
}

/// How far the targets reach to the sides of the line through the two that are farthest apart.
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
  if (touches.size() < kFewestPits)
    refuseRezero(std::to_string(touches.size()) + " touches, at least 3 are needed: touch the 5 pits shown");
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const std::string name = "touch " + std::to_string(touches[i].id);
    if (!finite(touches[i])) refuseRezero(name + " has a number that is none: touch that pit again");
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

MeasuredArm moved(const MeasuredArm& arm, std::span<const double> x, const glm::dvec3& middle_mm) {
  MeasuredArm now = arm;
  const glm::dquat turn = turnBy({x[0], x[1], x[2]});
  const glm::dvec3 shift_mm(x[3], x[4], x[5]);
  now.X_WD = {glm::normalize(turn * arm.X_WD.rotation),
              middle_mm + turn * (arm.X_WD.translation_mm - middle_mm) + shift_mm};
  for (std::size_t i = 0; i < 3; ++i) now.correction.offset_rad[i] += x[6 + i];
  return now;
}

/// The most probable arm given the touches not left out.
MeasuredArm fitted(const MeasuredArm& arm, const Touches& touches, const std::vector<bool>& out,
                   const TouchPrecision& precision) {
  const glm::dvec3 middle_mm = middleOf_mm(touches);
  const glm::dvec3 sigma_mm = touchSigma_mm(precision, kLeft_mm);
  LeastSquares problem;
  problem.start.assign(kRezeroNumbers, 0.0);
  problem.priors.assign(kRezeroNumbers, {});
  for (std::size_t i = 6; i < kRezeroNumbers; ++i) problem.priors[i].sigma = radFromDegrees(kHomingSigma_deg);
  problem.residuals = 3 * static_cast<std::size_t>(std::count(out.begin(), out.end(), false));
  problem.residuals_at = [&](std::span<const double> x, std::span<double> r) {
    const MeasuredArm tried = moved(arm, x, middle_mm);
    std::size_t row = 0;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (out[i]) continue;
      const glm::dvec3 off = (tried.tip_W(touches[i].joints_rad) - touches[i].target_W).xyz / sigma_mm;
      for (int axis = 0; axis < 3; ++axis) r[row++] = off[axis];
    }
  };
  return moved(arm, solved(problem).numbers, middle_mm);
}

double off_mm(const MeasuredArm& arm, const Touch& touch) {
  return glm::length((arm.tip_W(touch.joints_rad) - touch.target_W).xyz);
}

double rms_mm(const MeasuredArm& arm, const Touches& touches, const std::vector<bool>& out) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (out[i]) continue;
    sum += std::pow(off_mm(arm, touches[i]), 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

/// Leaves out touches that the others contradict, the worst first: so few points forgive a wild one by turning the
/// base, so each is foretold from the others alone.
std::vector<bool> contradicted(const MeasuredArm& arm, const Touches& touches, const TouchPrecision& precision) {
  std::vector<bool> out(touches.size(), false);
  const double least_mm = std::hypot(kStrayPit_mm, 3.0 * std::hypot(precision.in_plane_mm, precision.along_sight_mm));
  // Four touches or more must agree on who is wrong.
  for (std::size_t rounds = (touches.size() - kFewestPits) / 2; rounds > 0; --rounds) {
    std::size_t worst = touches.size();
    double best_rms_mm = rms_mm(fitted(arm, touches, out, precision), touches, out);
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (out[i]) continue;
      std::vector<bool> without = out;
      without[i] = true;
      const MeasuredArm others = fitted(arm, touches, without, precision);
      const double rest_mm = rms_mm(others, touches, without);
      if (rest_mm < best_rms_mm && off_mm(others, touches[i]) > std::max(least_mm, kStrayPitTimes * rest_mm)) {
        best_rms_mm = rest_mm;
        worst = i;
      }
    }
    if (worst == touches.size()) break;
    out[worst] = true;
  }
  return out;
}

}  // namespace

Rezero rezeroed(const MeasuredArm& arm, const TouchSet& set) {
  Touches touches;
  for (const Touch& touch : set.touches)
    if (touch.used) touches.push_back(touch);
  check(touches);

  const std::vector<bool> out = contradicted(arm, touches, set.precision);
  Rezero result;
  result.arm = fitted(arm, touches, out, set.precision);
  result.before_rms_mm = rms_mm(arm, touches, out);
  result.after_rms_mm = rms_mm(result.arm, touches, out);
  result.outliers = static_cast<int>(std::count(out.begin(), out.end(), true));

  // Of every touch that was given, those set aside too.
  std::size_t next = 0;
  for (const Touch& touch : set.touches)
    result.residuals.push_back(
        {touch.id, touch.target_W, result.arm.tip_W(touch.joints_rad) - touch.target_W, touch.used && !out[next++]});

  result.turned_deg = degreesFromRad(angleBetween_rad(arm.X_WD.rotation, result.arm.X_WD.rotation));
  result.moved_mm = glm::distance(result.arm.X_WD.translation_mm, arm.X_WD.translation_mm);
  for (std::size_t i = 0; i < 3; ++i)
    result.offset_change_deg[i] = degreesFromRad(result.arm.correction.offset_rad[i] - arm.correction.offset_rad[i]);
  return result;
}

}  // namespace calibration
