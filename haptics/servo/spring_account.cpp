#include "haptics/servo/spring_account.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

constexpr int kHalvings = 30;

}  // namespace

double SpringAccount::force_N(double deflection_mm) const noexcept {
  return -max_force_N_ * std::expm1(-stiffness_N_per_mm_ * deflection_mm / max_force_N_);
}

double SpringAccount::stored_Nmm(double deflection_mm) const noexcept {
  return max_force_N_ * deflection_mm - max_force_N_ / stiffness_N_per_mm_ * force_N(deflection_mm);
}

double SpringAccount::covered_mm(double deflection_mm, double last_work_Nmm, double along_mm) const noexcept {
  // In debt the spring acts as far as the hand draws it now.
  const double budget_Nmm = std::max(balance_Nmm_ - 0.5 * last_work_Nmm + kTolerance_Nmm, 0.0);
  const auto is_covered = [&](double c_mm) { return stored_Nmm(c_mm) + 0.5 * force_N(c_mm) * along_mm <= budget_Nmm; };
  if (is_covered(deflection_mm)) return deflection_mm;
  double covered = 0.0, beyond = deflection_mm;
  for (int n = 0; n < kHalvings; ++n) {
    const double middle = 0.5 * (covered + beyond);
    (is_covered(middle) ? covered : beyond) = middle;
  }
  return covered;
}

void SpringAccount::close(double work_Nmm, double deflection_mm) noexcept {
  balance_Nmm_ = std::min(balance_Nmm_ - work_Nmm, stored_Nmm(deflection_mm));
}

}  // namespace haptics
