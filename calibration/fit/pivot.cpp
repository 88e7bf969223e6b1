#include "calibration/fit/pivot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "calibration/fit/least_squares.h"
#include "calibration/fit/touch_checks.h"

namespace calibration {
namespace {

constexpr std::size_t kPivotNumbers = 6;  ///< tip in H, pit in D
constexpr double kLeastKnown = 1.5;  ///< sigma of the tip over that of a hold: swung in a plane it grows without end

[[noreturn]] void refuse(const char* format, double value) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, value);
  throw CalibrationError(std::string("pivot: ") + line.data());
}

void check(const std::vector<RawJoints>& holds_rad) {
  if (holds_rad.size() < kFewestHolds)
    refuse("%.0f ways of holding are too few, hold it in 12 or more", static_cast<double>(holds_rad.size()));
  for (std::size_t i = 0; i < holds_rad.size(); ++i)
    if (std::ranges::any_of(holds_rad[i], [](double angle_rad) { return !std::isfinite(angle_rad); }))
      refuse("hold %.0f has an angle that is none, hold it so again", static_cast<double>(i + 1));
}

}  // namespace

Pivot pivoted(const PhantomGeometry& geometry, const ArmCorrection& correction,
              const std::vector<RawJoints>& holds_rad) {
  check(holds_rad);
  std::vector<Pose<Device, Handle>> holds;
  std::vector<glm::dvec3> directions;
  for (const RawJoints& raw : holds_rad) {
    holds.push_back(handlePose(geometry, correction, raw));
    directions.push_back(holds.back().rotation * glm::dvec3(0.0, 0.0, 1.0));
  }
  Pivot pivot;
  pivot.tilt_spread_deg = pairSpread_deg(directions);
  if (pivot.tilt_spread_deg < kLeastSwing_deg)
    refuse("the handle was swung by %.0f degrees, at least 40 are needed, swing it wider", pivot.tilt_spread_deg);

  // R tip - pit = -place, by normal equations: R^T R and the pits' part are n times the identity.
  std::array<double, kPivotNumbers * kPivotNumbers> normal{};
  std::array<double, kPivotNumbers> numbers{};
  const double n = static_cast<double>(holds.size());
  for (std::size_t k = 0; k < kPivotNumbers; ++k) normal[k * kPivotNumbers + k] = n;
  for (const Pose<Device, Handle>& hold : holds) {
    const glm::dmat3 R = glm::mat3_cast(hold.rotation);
    const glm::dvec3 of_tip = glm::transpose(R) * -hold.translation_mm;
    for (int r = 0; r < 3; ++r) {
      const auto row = static_cast<std::size_t>(r);
      numbers[row] += of_tip[r];
      numbers[3 + row] += hold.translation_mm[r];
      for (int c = 0; c < 3; ++c) {
        const auto column = static_cast<std::size_t>(c);
        normal[(3 + row) * kPivotNumbers + column] -= R[c][r];
        normal[column * kPivotNumbers + 3 + row] -= R[c][r];
      }
    }
  }
  if (!choleskyFactored(normal, kPivotNumbers))
    refuse("the handle only turned about itself, swing it to all sides", 0.0);
  choleskySolved(normal, kPivotNumbers, numbers);
  pivot.tip_H_mm = {numbers[0], numbers[1], numbers[2]};
  pivot.pit_D = {{numbers[3], numbers[4], numbers[5]}};

  // How much of one hold's error is left in the tip.
  double least_known = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, kPivotNumbers> unit{};
    unit[k] = 1.0;
    choleskySolved(normal, kPivotNumbers, unit);
    least_known = std::max(least_known, std::sqrt(unit[k]));
  }
  if (!(least_known < kLeastKnown)) refuse("the handle was swung in one plane only, swing it to all sides", 0.0);

  double sum = 0.0;
  for (const Pose<Device, Handle>& hold : holds)
    sum += std::pow(glm::distance((hold * Point<Handle>{pivot.tip_H_mm}).mm, pivot.pit_D.mm), 2);
  pivot.rms_mm = std::sqrt(sum / n);
  pivot.sigma_mm = least_known * std::sqrt(sum / (3.0 * n - kPivotNumbers));
  if (!(pivot.rms_mm <= kMostWandering_mm))
    refuse("the tip wandered by %.2f mm, more than 0.3, see that it stays in the pit and the arm is calibrated",
           pivot.rms_mm);
  return pivot;
}

}  // namespace calibration
