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
  strict.max_speed_mm_per_s = std::min(limits.max_speed_mm_per_s, 2'000.0);
  strict.max_angular_speed_rad_per_s = std::min(limits.max_angular_speed_rad_per_s, 100.0);
  strict.slew_N_per_s = std::min(limits.slew_N_per_s, defaults.slew_N_per_s);
  strict.slew_Nmm_per_s = std::min(limits.slew_Nmm_per_s, defaults.slew_Nmm_per_s);
  return strict;
}

SafetyLimits sanitised(const SafetyLimits& limits) {
  const SafetyLimits defaults;
  SafetyLimits safe = limits;
  for (double* one : {&safe.peak_force_N, &safe.peak_torque_Nmm, &safe.max_stiffness_N_per_mm,
                      &safe.max_damping_Ns_per_mm, &safe.continuous_force_N})
    *one = peak(*one);
  for (int joint = 0; joint < 3; ++joint)
    safe.peak_joint_torque_Nmm[joint] = sanitisedJointPeak_Nmm(safe.peak_joint_torque_Nmm[joint]);
  safe.slew_N_per_s = positive(safe.slew_N_per_s, defaults.slew_N_per_s);
  safe.slew_Nmm_per_s = positive(safe.slew_Nmm_per_s, defaults.slew_Nmm_per_s);
  safe.max_speed_mm_per_s = positive(safe.max_speed_mm_per_s, defaults.max_speed_mm_per_s);
  safe.max_angular_speed_rad_per_s = positive(safe.max_angular_speed_rad_per_s, defaults.max_angular_speed_rad_per_s);

  const auto sanitise = [&](double SafetyThresholds::*one) {
    safe.thresholds.*one = positive(safe.thresholds.*one, defaults.thresholds.*one);
  };
  using T = SafetyThresholds;
  for (double T::*one : {&T::max_pause_s, &T::arming_mm_per_s, &T::release_s, &T::soft_start_s, &T::soft_start_N_per_s,
                         &T::brake_mm_per_s, &T::cutoff_mm_per_s, &T::cutoff_s, &T::buzz_mm_per_s, &T::stale_s,
                         &T::stale_fade_s, &T::max_stale_s, &T::warm_motor, &T::share_at_hottest})
    sanitise(one);
  return safe;
}

}  // namespace haptics
