#include "haptics/safety/safety_limits.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

double peak(double value) { return std::isfinite(value) && value >= 0.0 ? value : 0.0; }
double positive(double value, double otherwise) { return std::isfinite(value) && value > 0.0 ? value : otherwise; }

}  // namespace

SafetyLimits strict(const SafetyLimits& limits) {
  const SafetyLimits defaults;
  SafetyLimits strict = limits;
  strict.must_be_armed = true;
  strict.thresholds = {};
  strict.fastest_mm_per_s = std::min(limits.fastest_mm_per_s, 2'000.0);
  strict.fastest_turn_rad_per_s = std::min(limits.fastest_turn_rad_per_s, 100.0);
  strict.slew_N_per_s = std::min(limits.slew_N_per_s, defaults.slew_N_per_s);
  strict.slew_Nmm_per_s = std::min(limits.slew_Nmm_per_s, defaults.slew_Nmm_per_s);
  return strict;
}

SafetyLimits sanitised(const SafetyLimits& limits) {
  const SafetyLimits defaults;
  SafetyLimits safe = limits;
  for (double* one : {&safe.peak_force_N, &safe.peak_torque_Nmm, &safe.most_stiffness_N_per_mm,
                      &safe.most_damping_Ns_per_mm, &safe.continuous_force_N})
    *one = peak(*one);
  for (int joint = 0; joint < 3; ++joint)
    safe.peak_joint_torque_Nmm[joint] = readJointPeak_Nmm(safe.peak_joint_torque_Nmm[joint]);
  safe.slew_N_per_s = positive(safe.slew_N_per_s, defaults.slew_N_per_s);
  safe.slew_Nmm_per_s = positive(safe.slew_Nmm_per_s, defaults.slew_Nmm_per_s);
  safe.fastest_mm_per_s = positive(safe.fastest_mm_per_s, defaults.fastest_mm_per_s);
  safe.fastest_turn_rad_per_s = positive(safe.fastest_turn_rad_per_s, defaults.fastest_turn_rad_per_s);

  const auto tidy = [&](double SafetyThresholds::*one) {
    safe.thresholds.*one = positive(safe.thresholds.*one, defaults.thresholds.*one);
  };
  using T = SafetyThresholds;
  for (double T::*one : {&T::longest_pause_s, &T::arming_mm_per_s, &T::let_go_s, &T::soft_start_s,
                         &T::soft_start_N_per_s, &T::braked_mm_per_s, &T::cut_mm_per_s, &T::cut_s, &T::buzz_mm_per_s,
                         &T::stale_s, &T::stale_fades_s, &T::longest_stale_s, &T::warm_motor, &T::share_of_hottest})
    tidy(one);
  return safe;
}

}  // namespace haptics
