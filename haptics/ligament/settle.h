// Newton steps to the least energy of one rigid body or of two, the same for forceps and elevators. Settled is below
// 5 mN (or what the caller bears), or 5e-7 mJ still to gain, or a step below 2 µm that did not halve the residual:
// where a distance field's slope has kinks, at the faces of its cells, the least energy may lie on one with a residual
// left. mm, N, N mm. Servo thread; bounded by 6 evaluations. Method: reference/extraction 3.2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "haptics/ligament/six.h"

namespace haptics {

inline constexpr int kMostEvaluations = 6;

/// Longest step of one evaluation: snapping fibres move a piece by at most six of them in a tick.
inline constexpr double kMostStep_mm = 0.2, kMostStep_rad = 0.04;

/// Largest force, or torque by `lever` (1/mm to give a force, mm to give a way).
template <std::size_t N>
double largest(const std::array<double, N>& of, double lever) noexcept {
  double most = 0.0;
  for (std::size_t n = 0; n < N; ++n) most = std::max(most, std::fabs(of[n]) * (n % 6 < 3 ? 1.0 : lever));
  return most;
}

template <std::size_t N>
void limit(std::array<double, N>& step) noexcept {
  double over = 1.0;
  for (std::size_t n = 0; n < N; ++n)
    over = std::max(over, std::fabs(step[n]) / (n % 6 < 3 ? kMostStep_mm : kMostStep_rad));
  for (double& part : step) part /= over;
}

/// What counts as balanced.
inline constexpr double kBalanced_N = 5e-3;

struct SettleEffort {
  int evaluations = 0;
  bool unsettled = false;
};

/// A `Tried` has balance.energy_Nmm, balance.gradient, balance.hessian and residual_N. `first` counts as one
/// evaluation; after_step(from, step) is the next.
template <std::size_t N, class Tried, class AfterStep>
Tried settled(const Tried& first, double balanced_N, double lever_mm, const AfterStep& after_step,
              SettleEffort& effort) noexcept {
  constexpr double kGain_Nmm = 5e-7, kKink_mm = 2e-3;
  Tried best = first;
  effort = {1, false};
  while (best.residual_N >= balanced_N) {
    std::array<double, N> down{}, step{};
    for (std::size_t n = 0; n < N; ++n) down[n] = -best.balance.gradient[n];
    const bool is_finite = std::all_of(down.begin(), down.end(), [](double part) { return std::isfinite(part); });
    if (!is_finite || !solve(best.balance.hessian, down, step)) break;
    if (0.5 * std::inner_product(down.begin(), down.end(), step.begin(), 0.0) < kGain_Nmm) return best;
    limit(step);

    // A step is taken if energy or residual falls, else halved.
    const double length_mm = largest(step, lever_mm), before_N = best.residual_N;
    bool is_taken = false;
    while (!is_taken && effort.evaluations < kMostEvaluations) {
      const Tried next = after_step(best, step);
      ++effort.evaluations;
      is_taken = next.balance.energy_Nmm <= best.balance.energy_Nmm || next.residual_N < best.residual_N;
      if (is_taken) best = next;
      for (double& part : step) part *= 0.5;
    }
    if (!is_taken) break;
    if (length_mm < kKink_mm && best.residual_N > 0.5 * before_N) return best;
  }
  effort.unsettled = !(best.residual_N < balanced_N);
  return best;
}

}  // namespace haptics
