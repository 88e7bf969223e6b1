#include "haptics/ligament/hand_coupling.h"

#include <cmath>

#include "haptics/ligament/series.h"

namespace haptics {
namespace {

/// A torque 2 K sin(angle / 2) up to a bound; energy, and slope by the angle of the torque.
struct Turned {
  double torque_Nmm, energy_Nmm, slope_Nmm;
};

/// `sine` and `cosine` (>= 0) of half the angle.
Turned turned(double stiffness, double most, double sine, double cosine) noexcept {
  const double size = std::fabs(sine), sign = sine < 0.0 ? -1.0 : 1.0;
  if (2.0 * stiffness * size <= most)
    return {2.0 * stiffness * sine, 4.0 * stiffness * sine * sine / (1.0 + cosine), stiffness * cosine};
  const double bound = 0.5 * most / stiffness, bound_cosine = std::sqrt(std::fmax(0.0, 1.0 - bound * bound));
  const double at_bound = 4.0 * stiffness * bound * bound / (1.0 + bound_cosine);
  return {sign * most, at_bound + 2.0 * most * (arcSineOf(std::fmin(1.0, size)) - arcSineOf(bound)), 0.0};
}

}  // namespace

HandPull addHand(const ElevatorHand& hand, const ToolPose& X_PT, const glm::dvec3& middle_T_mm,
                 Balance& balance) noexcept {
  HandPull pull;
  const double before_Nmm = balance.energy_Nmm;
  const glm::dvec3 arm_mm = X_PT.rotation * -middle_T_mm;
  pull.on_blade.force_N.xyz =
      addPull(hand.stiffness_N_per_mm, hand.most_N, arm_mm, hand.X_PT.translation_mm - X_PT.translation_mm, balance);

  // The turn from blade to hand in T: a twist about z after a tilt across it.
  glm::dquat q = glm::conjugate(X_PT.rotation) * hand.X_PT.rotation;
  if (q.w < 0.0) q = -q;
  const double upright = std::sqrt(std::fmax(q.w * q.w + q.z * q.z, 1e-12));  // cosine of half the tilt
  const double tilt_sine = std::sqrt(q.x * q.x + q.y * q.y);
  const Turned twist = turned(hand.twist_Nmm_per_rad, hand.most_twist_Nmm, q.z / upright, q.w / upright);
  const Turned tilt = turned(hand.tilt_Nmm_per_rad, hand.most_tilt_Nmm, tilt_sine, upright);

  // How both angles fall as the blade turns about its axes.
  const double per2 = 1.0 / (upright * upright);
  const glm::dvec3 twist_way(per2 * (q.w * q.y + q.z * q.x), per2 * (q.z * q.y - q.w * q.x), 1.0);
  const glm::dvec3 across(q.w * q.x - q.z * q.y, q.w * q.y + q.z * q.x, 0.0);
  const double across_length = glm::length(across);
  const glm::dvec3 tilt_way = across_length > 0.0 ? across / across_length : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 other_way(-tilt_way.y, tilt_way.x, 0.0);
  const double other_slope = tilt_sine > 1e-9 ? 0.5 * tilt.torque_Nmm * upright / tilt_sine : tilt.slope_Nmm;

  const glm::dvec3 torque_T = twist.torque_Nmm * twist_way + tilt.torque_Nmm * tilt_way;
  const glm::dmat3 slope_T = twist.slope_Nmm * glm::outerProduct(twist_way, twist_way) +
                             tilt.slope_Nmm * glm::outerProduct(tilt_way, tilt_way) +
                             other_slope * glm::outerProduct(other_way, other_way);
  const glm::dmat3 R = glm::mat3_cast(X_PT.rotation);
  const glm::dmat3 slope_P = R * slope_T * glm::transpose(R);
  pull.on_blade.torque_Nmm.xyz = R * torque_T;
  for (std::size_t row = 0; row < 3; ++row) {
    const int i = static_cast<int>(row);
    balance.gradient[3 + row] -= pull.on_blade.torque_Nmm.xyz[i];
    for (std::size_t column = row; column < 3; ++column)
      balance.hessian(3 + row, 3 + column) += slope_P[static_cast<int>(column)][i];
  }
  balance.energy_Nmm += twist.energy_Nmm + tilt.energy_Nmm;
  pull.twist_Nmm = twist.torque_Nmm;
  pull.stored_Nmm = balance.energy_Nmm - before_Nmm;
  return pull;
}

bool isUsable(const ElevatorHand& hand) noexcept {
  const glm::dquat& q = hand.X_PT.rotation;
  const auto usable = [](double stiffness, double most) {
    return stiffness >= 0.0 && std::isfinite(stiffness) && most >= 0.0;
  };
  return calibration::isFinite(hand.X_PT.translation_mm) && std::isfinite(q.w + q.x + q.y + q.z) &&
         std::fabs(glm::dot(q, q) - 1.0) < 1e-6 && usable(hand.stiffness_N_per_mm, hand.most_N) &&
         usable(hand.twist_Nmm_per_rad, hand.most_twist_Nmm) && usable(hand.tilt_Nmm_per_rad, hand.most_tilt_Nmm);
}

}  // namespace haptics
