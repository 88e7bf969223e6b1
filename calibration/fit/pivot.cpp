#include "calibration/fit/pivot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <glm/gtc/type_ptr.hpp>

#include "calibration/fit/touch_checks.h"

namespace calibration {
namespace {

constexpr int kPivotNumbers = 6;   ///< tip in H, pit in D
constexpr double kMinKnown = 1.5;  ///< tip sigma over hold sigma: unbounded for a swing in one plane

[[noreturn]] void refuse(const std::string& what) { throw CalibrationError("pivot: " + what); }

void check(const std::vector<RawJoints>& holds_rad) {
  if (holds_rad.size() < kMinHolds)
    refuse(fmt::format("{} ways of holding are too few, hold it in 12 or more", holds_rad.size()));
  for (std::size_t i = 0; i < holds_rad.size(); ++i)
    if (std::ranges::any_of(holds_rad[i], [](double angle_rad) { return !std::isfinite(angle_rad); }))
      refuse(fmt::format("hold {} has an angle that is not finite, repeat it", i + 1));
}

}  // namespace

Pivot fitPivot(const PhantomGeometry& geometry, const ArmCorrection& correction,
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
  if (pivot.tilt_spread_deg < kMinSwing_deg)
    refuse(fmt::format("the handle was swung by {:.0f} degrees, at least 40 are needed, swing it wider",
                       pivot.tilt_spread_deg));

  // R tip - pit = -position, by normal equations; R^T R and the pits' block are n times the identity.
  using Six = Eigen::Matrix<double, kPivotNumbers, 1>;
  const double n = static_cast<double>(holds.size());
  Eigen::Matrix<double, kPivotNumbers, kPivotNumbers> normal = n * decltype(normal)::Identity();
  Six right = Six::Zero();
  for (const Pose<Device, Handle>& hold : holds) {
    const glm::dmat3 rotation = glm::mat3_cast(hold.rotation);
    const Eigen::Map<const Eigen::Matrix3d> R(glm::value_ptr(rotation));
    const Eigen::Map<const Eigen::Vector3d> position(glm::value_ptr(hold.translation_mm));
    right += (Six() << -R.transpose() * position, position).finished();
    normal.bottomLeftCorner<3, 3>() -= R;
    normal.topRightCorner<3, 3>() -= R.transpose();
  }
  const Eigen::LLT<decltype(normal)> factor(normal);
  const Six numbers = factor.solve(right);
  pivot.tip_H_mm = {numbers[0], numbers[1], numbers[2]};
  pivot.pit_D = {{numbers[3], numbers[4], numbers[5]}};

  // Error of the tip per error of one hold.
  const Six squared = factor.solve(decltype(normal)::Identity()).diagonal();
  const double min_known = std::sqrt(squared.head<3>().maxCoeff());
  if (factor.info() != Eigen::Success || !(min_known < kMinKnown))
    refuse("the handle was swung in one plane only, swing it to all sides");

  double sum = 0.0;
  for (const Pose<Device, Handle>& hold : holds)
    sum += std::pow(glm::distance((hold * Point<Handle>{pivot.tip_H_mm}).mm, pivot.pit_D.mm), 2);
  pivot.rms_mm = std::sqrt(sum / n);
  pivot.sigma_mm = min_known * std::sqrt(sum / (3.0 * n - kPivotNumbers));
  if (!(pivot.rms_mm <= kMaxPivotRms_mm))
    refuse(
        fmt::format("the tip moved by {:.2f} mm, more than 0.3, see that it stays in the pit and the arm is calibrated",
                    pivot.rms_mm));
  return pivot;
}

}  // namespace calibration
