#include "haptics/servo/tear_pulses.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

/// The course of a pulse, integrated: its derivative has the peak 1 where u (1-u) = 1/5.
double course(double u) {
  constexpr double kPeak = 0.053665631459994955;  // 3 / 25 / sqrt(5)
  const double v = u * (1.0 - u);
  return v * v * v / kPeak;
}

/// Across the axis, the same for the same axis.
glm::dvec3 across(const glm::dvec3& axis) {
  const glm::dvec3 least = std::abs(axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 v = least - glm::dot(least, axis) * axis;
  const double length = std::sqrt(glm::dot(v, v));
  return length > 1e-3 ? v / length : glm::dvec3(0.0);
}

}  // namespace

void TearPulses::start(double peak_N, double duration_s, const glm::dvec3& tool_axis_P) noexcept {
  peak_N_ = peak_N;
  duration_s_ = duration_s;
  at_s_ = 0.0;
  side_ = -side_;
  across_P_ = side_ * across(tool_axis_P);
}

calibration::Vector<calibration::Patient> TearPulses::update(double torn_Nmm, bool cracks,
                                                             const glm::dvec3& tool_axis_P, double dt_s) noexcept {
  if (torn_Nmm > 0.0) waiting_Nmm_ += torn_Nmm;
  cracks_ = cracks_ || cracks;
  if (at_s_ >= duration_s_) {
    if (cracks_) {
      start(kCrack_N, kCrack_s, tool_axis_P);
      cracks_ = false;
      waiting_Nmm_ = 0.0;
    } else if (waiting_Nmm_ >= kGrain_Nmm) {
      const double more = std::min(1.0, (waiting_Nmm_ / kGrain_Nmm - 1.0) / kSteps);
      start(kWeakest_N + more * (kStrongest_N - kWeakest_N), kPulse_s, tool_axis_P);
      waiting_Nmm_ = 0.0;
    }
  }
  if (at_s_ >= duration_s_) return {};

  // The mean over the tick, so that the sum over a pulse is zero.
  const double from = at_s_ / duration_s_, to = std::min(1.0, (at_s_ + dt_s) / duration_s_);
  at_s_ = to < 1.0 ? at_s_ + dt_s : duration_s_;
  return {peak_N_ * (course(to) - course(from)) * (duration_s_ / dt_s) * across_P_};
}

}  // namespace haptics
