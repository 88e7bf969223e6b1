#include "haptics/device/simulated/virtual_hand.h"

#include <cmath>

namespace haptics {
namespace {

/// Response of position and velocity, after a time, to a unit of each: x'' = -2 a x' - w2 x.
struct Response {
  double x_of_x = 1.0, x_of_v = 0.0, v_of_x = 0.0, v_of_v = 1.0;
};

Response responseAfter(double a, double w2, double dt_s) {
  // e^(-a t) (C, S) with C = cosh, cos or 1 and S = sinh/r, sin/r or t.
  const double r2 = a * a - w2, r = std::sqrt(std::abs(r2)), x = r * dt_s, decay = std::exp(-a * dt_s);
  double C = 1.0, S = dt_s;
  if (x < 1e-5) {
    C += 0.5 * r2 * dt_s * dt_s;
  } else {
    const double e = std::exp(r2 > 0.0 ? x : 0.0);
    C = r2 > 0.0 ? 0.5 * (e + 1.0 / e) : std::cos(x);
    S = (r2 > 0.0 ? 0.5 * (e - 1.0 / e) : std::sin(x)) / r;
  }
  return {decay * (C + a * S), decay * S, -decay * w2 * S, decay * (C - a * S)};
}

}  // namespace

HandleState VirtualHand::follow(const HandTarget& from, const HandTarget& to,
                                const Wrench<calibration::Device>& wrench_D, double dt_s) {
  advance(from.position_mm, dt_s > 0.0 ? (to.position_mm - from.position_mm) / dt_s : glm::dvec3(0.0),
          wrench_D.force_N.xyz, dt_s);
  HandleState state;
  state.X_DH = {to.rotation, position_mm};
  state.velocity_D_mm_per_s.xyz = velocity_mm_per_s;
  state.pedal = to.pedal;
  return state;
}

void VirtualHand::advance(const glm::dvec3& target_mm, const glm::dvec3& target_velocity_mm_per_s,
                          const glm::dvec3& force_N, double dt_s) {
  if (!std::isfinite(glm::length(force_N)) || !std::isfinite(glm::length(target_mm)) ||
      !std::isfinite(glm::length(target_velocity_mm_per_s)))
    return;
  // N/mm and N s/mm over kg, in 1/s^2 and 1/s.
  const double per_kg = 1000.0 / mass_kg;
  const double a = 0.5 * per_kg * totalDamping_Ns_per_mm(), w2 = per_kg * stiffness_N_per_mm;
  const glm::dvec3 push_N = force_N - friction_Ns_per_mm * target_velocity_mm_per_s;
  const glm::dvec3 drift = velocity_mm_per_s - target_velocity_mm_per_s;

  if (stiffness_N_per_mm > 0.0) {
    // About the position where target and force balance.
    const Response to = responseAfter(a, w2, dt_s);
    const glm::dvec3 rest_mm = target_mm + push_N / stiffness_N_per_mm, away = position_mm - rest_mm;
    position_mm = rest_mm + target_velocity_mm_per_s * dt_s + to.x_of_x * away + to.x_of_v * drift;
    velocity_mm_per_s = target_velocity_mm_per_s + to.v_of_x * away + to.v_of_v * drift;
    return;
  }
  // Not gripped: only friction and force, towards the speed at which they balance.
  const glm::dvec3 thrust = per_kg * push_N;
  const double d = 2.0 * a, fallen = d > 0.0 ? -std::expm1(-d * dt_s) / d : dt_s;
  const double left = d > 0.0 ? (dt_s - fallen) / d : 0.5 * dt_s * dt_s;
  position_mm += target_velocity_mm_per_s * dt_s + fallen * drift + left * thrust;
  velocity_mm_per_s = target_velocity_mm_per_s + (1.0 - d * fallen) * drift + fallen * thrust;
}

}  // namespace haptics
