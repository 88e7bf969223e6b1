#include "haptics/safety/passivity.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;

double work_Nmm(const Wrench<Patient>& wrench, const Passivity::Motion& motion) {
  return glm::dot(wrench.force_N.xyz, motion.travel_P_mm.xyz) + glm::dot(wrench.torque_Nmm.xyz, motion.turn_P_rad.xyz);
}

/// The largest f >= 0 with  way f + hold f^2 <= budget.
double largestForce_N(double way_mm, double hold_mm_per_N, double budget_Nmm) {
  if (budget_Nmm <= 0.0) return 0.0;
  // The form that does not cancel for small budgets.
  return 2.0 * budget_Nmm / (way_mm + std::sqrt(way_mm * way_mm + 4.0 * hold_mm_per_N * budget_Nmm));
}

}  // namespace

Wrench<Patient> Passivity::allow(const Wrench<Patient>& wanted, const Motion& motion, double slew_N_per_s,
                                 double dt_s) const noexcept {
  const glm::dvec3 travel = motion.travel_P_mm.xyz, turn = kLever_mm * motion.turn_P_rad.xyz;
  const double way_mm = std::sqrt(glm::dot(travel, travel) + glm::dot(turn, turn));
  if (!(way_mm > 1e-12)) return wanted;

  const double budget_Nmm = energy_Nmm_ + kGrace_Nmm - 0.5 * work_Nmm(last_, motion);
  const double most_N = largestForce_N(way_mm, way_mm / (2.0 * slew_N_per_s * dt_s), budget_Nmm);
  const double along_N = work_Nmm(wanted, motion) / way_mm;
  if (!(along_N > most_N)) return wanted;

  const double withheld = (along_N - most_N) / way_mm;
  return {{wanted.force_N.xyz - withheld * travel}, {wanted.torque_Nmm.xyz - withheld * kLever_mm * turn}};
}

void Passivity::enter(const Wrench<Patient>& given, const Motion& motion, double most_stored_Nmm) noexcept {
  energy_Nmm_ -= 0.5 * (work_Nmm(last_, motion) + work_Nmm(given, motion));
  energy_Nmm_ = std::clamp(energy_Nmm_, -kMostDebt_Nmm, std::max(0.0, most_stored_Nmm));
  last_ = given;
}

}  // namespace haptics
