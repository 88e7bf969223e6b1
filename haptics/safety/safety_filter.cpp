#include "haptics/safety/safety_filter.h"

#include <cmath>

namespace haptics {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Shortened to `most`; true when it had to be.
bool shorten(glm::dvec3& v, double most) {
  const double length = glm::length(v);
  if (length <= most) return false;
  v = std::isfinite(length) && most > 0.0 ? v * (most / length) : glm::dvec3(0.0);
  return true;
}

/// One of the two vectors on its way from `last`: within its peak, then no further from the last than the slew lets it.
glm::dvec3 limited(glm::dvec3 target, const glm::dvec3& last, double peak, double longest_step, Fault& faults) {
  if (shorten(target, peak)) faults = faults | Fault::clamped;
  glm::dvec3 change = target - last;
  if (!shorten(change, longest_step)) return target;
  faults = faults | Fault::slewed;
  target = last + change;
  shorten(target, peak);  // only when the limit itself has fallen
  return target;
}

}  // namespace

SafetyLimits sanitised(const SafetyLimits& limits) {
  const SafetyLimits defaults;
  const auto peak = [](double value) { return std::isfinite(value) && value >= 0.0 ? value : 0.0; };
  const auto slew = [](double value, double otherwise) {
    return std::isfinite(value) && value > 0.0 ? value : otherwise;
  };
  return {peak(limits.peak_force_N), slew(limits.slew_N_per_s, defaults.slew_N_per_s), peak(limits.peak_torque_Nmm),
          slew(limits.slew_Nmm_per_s, defaults.slew_Nmm_per_s), peak(limits.most_stiffness_N_per_mm)};
}

SafetyFilter::Served SafetyFilter::serve(const Wrench<calibration::Patient>& wanted_P, const SafetyLimits& limits,
                                         bool ramp_down, double dt_s) noexcept {
  const SafetyLimits safe = sanitised(limits);
  Served served;
  Wrench<calibration::Patient> target = wanted_P;
  const bool usable = finite(target.force_N.xyz) && finite(target.torque_Nmm.xyz);
  if (!usable) served.faults = Fault::bad_force;
  if (ramp_down || !usable) target = {};

  last_P_.force_N.xyz =
      limited(target.force_N.xyz, last_P_.force_N.xyz, safe.peak_force_N, safe.slew_N_per_s * dt_s, served.faults);
  last_P_.torque_Nmm.xyz = limited(target.torque_Nmm.xyz, last_P_.torque_Nmm.xyz, safe.peak_torque_Nmm,
                                   safe.slew_Nmm_per_s * dt_s, served.faults);
  served.wrench_P = last_P_;
  return served;
}

}  // namespace haptics
