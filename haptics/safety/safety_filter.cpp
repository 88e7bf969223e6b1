#include "haptics/safety/safety_filter.h"

#include <cmath>

#include "calibration/geometry/pose.h"
#include "haptics/safety/joint_torques.h"

namespace haptics {
namespace {

using calibration::isFinite;

/// Shortened to `most`; true when it had to be.
bool shorten(glm::dvec3& v, double most) {
  const double length = glm::length(v);
  if (length <= most) return false;
  v = std::isfinite(length) && most > 0.0 ? v * (most / length) : glm::dvec3(0.0);
  return true;
}

/// `target` within its peak and within the slew limit of `last`.
glm::dvec3 limited(glm::dvec3 target, glm::dvec3 last, double peak, double longest_step, bool at_once, Fault& faults) {
  if (shorten(target, peak)) faults = faults | Fault::clamped;
  if (at_once) shorten(last, glm::length(target));
  glm::dvec3 change = target - last;
  if (!shorten(change, longest_step)) return target;
  faults = faults | Fault::slewed;
  target = last + change;
  shorten(target, peak);  // only when the limit itself has fallen
  return target;
}

}  // namespace

SafetyFilter::Delivered SafetyFilter::serve(const Wrench<calibration::Patient>& requested_P, const SafetyLimits& limits,
                                            Fall fall, double dt_s, const glm::dmat3& jacobian_P_mm) noexcept {
  Delivered delivered;
  Wrench<calibration::Patient> target = requested_P;
  if (!isFinite(target.force_N.xyz) || !isFinite(target.torque_Nmm.xyz)) {
    delivered.faults = Fault::bad_force;
    target = {};
  }

  const auto bear = [&](glm::dvec3& force_N) {
    const double share = shareForJoints(jacobian_P_mm, force_N, limits.peak_joint_torque_Nmm);
    if (!(share < 1.0)) return;
    delivered.faults = delivered.faults | Fault::joints;
    force_N *= share;
  };
  bear(target.force_N.xyz);

  const bool at_once = fall == Fall::at_once;
  last_P_.force_N.xyz = limited(target.force_N.xyz, last_P_.force_N.xyz, limits.peak_force_N,
                                limits.slew_N_per_s * dt_s, at_once, delivered.faults);
  last_P_.torque_Nmm.xyz = limited(target.torque_Nmm.xyz, last_P_.torque_Nmm.xyz, limits.peak_torque_Nmm,
                                   limits.slew_Nmm_per_s * dt_s, at_once, delivered.faults);
  // The joints have moved since the last force was within their limits.
  bear(last_P_.force_N.xyz);
  delivered.wrench_P = last_P_;
  return delivered;
}

}  // namespace haptics
