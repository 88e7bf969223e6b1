#include "haptics/file/rk4_chain.h"

#include <cmath>
#include <numbers>

#include "haptics/file/material_frame.h"

namespace haptics {
namespace {

constexpr double kStable = 1.3;

PerNode<double> along(const PerNode<double>& from, double share, const PerNode<double>& way) {
  PerNode<double> sum = from;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * way[i];
  return sum;
}

}  // namespace

Rk4Chain::Rk4Chain(const FileChain& chain, double period_s, int substeps) noexcept
    : chain_(chain), substep_s_(period_s / substeps), substeps_(substeps) {
  double stiffest = 0.0;
  for (std::size_t i = 1; i <= chain.links; ++i) stiffest = std::fmax(stiffest, chain.bend[i].stiffness_Nmm_per_rad);
  inertia_ = kStable * stiffest * substep_s_ * substep_s_ / 2.0;
  const double part = std::numbers::pi / (2.0 * (2.0 * static_cast<double>(chain.links) + 1.0));
  const double first_rad_per_s =
      2.0 * std::sqrt(chain.bend[chain.links].stiffness_Nmm_per_rad / inertia_) * turnBy(part).y;
  damping_ = 2.0 * inertia_ * first_rad_per_s;
}

void Rk4Chain::refine(int times) noexcept {
  substeps_ *= times;
  substep_s_ /= times;
}

PerNode<double> Rk4Chain::accelerations(const PerNode<double>& angle, const PerNode<double>& rate,
                                        const PerNode<glm::dvec2>& beyond_N) const noexcept {
  PerNode<double> faster{};
  const auto moment = [&](std::size_t i) {
    const double bent = angle[i] - (i > 1 ? angle[i - 1] : 0.0);
    return chain_.bend[i].secant(bent * bent) * bent;
  };
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const glm::dvec2 turn = turnBy(angle[i]);
    double sum = chain_.link_mm * (beyond_N[i].x * turn.x - beyond_N[i].y * turn.y) - moment(i);
    if (i < chain_.links) sum += moment(i + 1);
    faster[i] = (sum - damping_ * rate[i]) / inertia_;
  }
  return faster;
}

void Rk4Chain::step(const PerNode<glm::dvec2>& force_N) noexcept {
  PerNode<glm::dvec2> beyond_N{};
  glm::dvec2 sum_N(0.0);
  for (std::size_t i = chain_.links; i >= 1; --i) beyond_N[i] = sum_N += force_N[i];

  const double h = substep_s_;
  for (int n = 0; n < substeps_; ++n) {
    const PerNode<double>&a = angle_rad_, &v = rate_rad_per_s_;
    const PerNode<double> k1 = accelerations(a, v, beyond_N), v2 = along(v, h / 2.0, k1);
    const PerNode<double> k2 = accelerations(along(a, h / 2.0, v), v2, beyond_N), v3 = along(v, h / 2.0, k2);
    const PerNode<double> k3 = accelerations(along(a, h / 2.0, v2), v3, beyond_N), v4 = along(v, h, k3);
    const PerNode<double> k4 = accelerations(along(a, h, v3), v4, beyond_N);
    for (std::size_t i = 1; i <= chain_.links; ++i) {
      angle_rad_[i] += h / 6.0 * (v[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
      rate_rad_per_s_[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
  }
}

glm::dvec2 Rk4Chain::node_mm(std::size_t node) const noexcept {
  glm::dvec2 sum_mm(0.0);
  for (std::size_t i = 1; i <= node; ++i) {
    const glm::dvec2 turn = turnBy(angle_rad_[i]);
    sum_mm += chain_.link_mm * glm::dvec2(turn.y, turn.x);
  }
  return sum_mm;
}

}  // namespace haptics
