#include "haptics/safety/passivity_controller.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;

constexpr double kDebtDecay_s = 1.0;

double work_Nmm(const Wrench<Patient>& wrench, const PassivityController::Motion& motion) {
  return glm::dot(wrench.force_N.xyz, motion.travel_P_mm.xyz) +
         glm::dot(wrench.torque_Nmm.xyz, motion.rotation_P_rad.xyz);
}

double length_mm(const PassivityController::Motion& motion) {
  const glm::dvec3 travel = motion.travel_P_mm.xyz,
                   rotation = PassivityController::kLever_mm * motion.rotation_P_rad.xyz;
  return std::sqrt(glm::dot(travel, travel) + glm::dot(rotation, rotation));
}

/// The largest f >= 0 with  way f + hold f^2 <= budget.
double largestForce_N(double way_mm, double hold_mm_per_N, double budget_Nmm) {
  if (budget_Nmm <= 0.0) return 0.0;
  // This form does not cancel for small budgets.
  return 2.0 * budget_Nmm / (way_mm + std::sqrt(way_mm * way_mm + 4.0 * hold_mm_per_N * budget_Nmm));
}

}  // namespace

Wrench<Patient> PassivityController::limit(const Wrench<Patient>& requested, const Motion& motion, double slew_N_per_s,
                                           double dt_s) const noexcept {
  const glm::dvec3 travel = motion.travel_P_mm.xyz, rotation = kLever_mm * motion.rotation_P_rad.xyz;
  const double way = length_mm(motion);
  if (!(way > 1e-12)) return requested;

  const double budget_Nmm = balance_Nmm(motion) + kTolerance_Nmm;
  const double max_N = largestForce_N(way, way / (2.0 * slew_N_per_s * dt_s), budget_Nmm);
  const double along_N = work_Nmm(requested, motion) / way;
  if (!(along_N > max_N)) return requested;

  const double withheld = (along_N - max_N) / way;
  return {{requested.force_N.xyz - withheld * travel}, {requested.torque_Nmm.xyz - withheld * kLever_mm * rotation}};
}

double PassivityController::balance_Nmm(const Motion& motion) const noexcept {
  return energy_Nmm_ - 0.5 * work_Nmm(last_, motion);
}

double PassivityController::maxForce_N(const Motion& motion, double dt_s) const noexcept {
  return std::max(0.0, 2.0 * (balance_Nmm(motion) + kMaxDebt_Nmm) / (length_mm(motion) + kMaxSpeed_mm_per_s * dt_s));
}

void PassivityController::observe(const Wrench<Patient>& commanded, const Motion& motion, double max_stored_Nmm,
                                  double dt_s) noexcept {
  energy_Nmm_ -= 0.5 * (work_Nmm(last_, motion) + work_Nmm(commanded, motion));
  if (energy_Nmm_ < -kRetainedDebt_Nmm)
    energy_Nmm_ -= (energy_Nmm_ + kRetainedDebt_Nmm) * std::min(1.0, dt_s / kDebtDecay_s);
  energy_Nmm_ = std::clamp(energy_Nmm_, -kMaxDebt_Nmm, std::max(0.0, max_stored_Nmm));
  last_ = commanded;
}

}  // namespace haptics
