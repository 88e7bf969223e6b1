#include "haptics/servo/safety.h"

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

}  // namespace

SafetyLimits sanitised(const SafetyLimits& limits) {
  SafetyLimits safe = limits;
  if (!std::isfinite(safe.peak_force_N) || safe.peak_force_N < 0.0) safe.peak_force_N = 0.0;
  if (!std::isfinite(safe.slew_N_per_s) || safe.slew_N_per_s <= 0.0) safe.slew_N_per_s = SafetyLimits{}.slew_N_per_s;
  return safe;
}

SafetyFilter::Served SafetyFilter::serve(const calibration::Vector<calibration::Patient>& wanted_P_N,
                                         const SafetyLimits& limits, bool ramp_down, double dt_s) noexcept {
  const SafetyLimits safe = sanitised(limits);
  Served served;
  glm::dvec3 target = wanted_P_N.xyz;
  if (!finite(target)) served.faults = served.faults | Fault::bad_force;
  if (ramp_down || !finite(target)) target = glm::dvec3(0.0);
  if (shorten(target, safe.peak_force_N)) served.faults = served.faults | Fault::clamped;

  glm::dvec3 change = target - last_N_;
  if (shorten(change, safe.slew_N_per_s * dt_s)) {
    served.faults = served.faults | Fault::slewed;
    target = last_N_ + change;
    shorten(target, safe.peak_force_N);  // only when the limit itself has fallen
  }
  last_N_ = target;
  served.force_P_N.xyz = target;
  return served;
}

}  // namespace haptics
