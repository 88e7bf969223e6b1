#include "haptics/file/file_twist.h"

#include <cmath>

namespace haptics {
namespace {

constexpr double kBalanced_Nmm = 1e-7;

struct TwistBalance {
  double energy_Nmm = 0.0, largest_Nmm = 0.0;
  PerNode<double> moment{}, diagonal{};
};

TwistBalance balanceOf(const FileChain& chain, const FileLaw& law, const TwistDrag& drag,
                       const PerNode<double>& start_rad, const PerNode<double>& roll_rad) {
  TwistBalance sum;
  for (std::size_t i = 1; i <= chain.links; ++i) {
    const double G = chain.twist_Nmm_per_rad[i], wound = roll_rad[i - 1] - roll_rad[i];
    sum.energy_Nmm += 0.5 * G * wound * wound;
    sum.moment[i] += G * wound;
    sum.moment[i - 1] -= G * wound;
    sum.diagonal[i] += G;
    if (i > 1) sum.diagonal[i - 1] += G;

    const double r = chain.radius_mm[i], turned = roll_rad[i] - start_rad[i];
    const glm::dvec2& stretch = drag.bristle[i].mm;
    const BristlePull pull = bristlePull(law.bristle_N_per_mm, drag.normal_N[i], stretch.y + r * turned, stretch.x);
    const double C = drag.friction[i].round;
    sum.energy_Nmm += C * pull.energy_Nmm - drag.screw_Nmm[i] * turned;
    sum.moment[i] += drag.screw_Nmm[i] - C * r * pull.N;
    sum.diagonal[i] += C * r * r * pull.N_per_mm;
  }
  for (std::size_t i = 1; i <= chain.links; ++i) sum.largest_Nmm = std::fmax(sum.largest_Nmm, std::fabs(sum.moment[i]));
  return sum;
}

/// The turn of each node that would balance the linear system.
PerNode<double> stepOf(const FileChain& chain, const TwistBalance& now) {
  PerNode<double> step = now.moment, pivot = now.diagonal;
  for (std::size_t i = 2; i <= chain.links; ++i) {
    const double share = chain.twist_Nmm_per_rad[i] / pivot[i - 1];
    pivot[i] -= share * chain.twist_Nmm_per_rad[i];
    step[i] += share * step[i - 1];
  }
  for (std::size_t i = chain.links; i >= 1; --i) {
    const double next = i < chain.links ? chain.twist_Nmm_per_rad[i + 1] * step[i + 1] : 0.0;
    step[i] = (step[i] + next) / pivot[i];
  }
  return step;
}

}  // namespace

TwistResult settleTwist(const FileChain& chain, const FileLaw& law, const TwistDrag& drag,
                        PerNode<double>& roll_rad) noexcept {
  const PerNode<double> start_rad = roll_rad;
  TwistBalance now = balanceOf(chain, law, drag, start_rad, roll_rad);
  for (int n = 0; n < kMostTwistSteps && now.largest_Nmm > kBalanced_Nmm; ++n) {
    const PerNode<double> step = stepOf(chain, now);
    bool is_taken = false;
    for (double share = 1.0; !is_taken && share > 0.01; share *= 0.4) {
      PerNode<double> tried_rad = roll_rad;
      for (std::size_t i = 1; i <= chain.links; ++i) tried_rad[i] += share * step[i];
      const TwistBalance tried = balanceOf(chain, law, drag, start_rad, tried_rad);
      is_taken = tried.energy_Nmm < now.energy_Nmm || tried.largest_Nmm < now.largest_Nmm;
      if (is_taken) roll_rad = tried_rad, now = tried;
    }
    if (!is_taken) break;
  }
  return {chain.twist_Nmm_per_rad[1] * (roll_rad[0] - roll_rad[1]), now.largest_Nmm > 1e3 * kBalanced_Nmm};
}

}  // namespace haptics
