#include "haptics/bone/lens_curve.h"

#include <cmath>

#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

using Values = std::array<double, LensCurve::kMaxCoefficients>;

/// Newton's divided differences over the nodes, multiplied out to powers of t.
Values interpolated(const Values& node, Values value, int count) {
  for (int order = 1; order < count; ++order)
    for (int i = count - 1; i >= order; --i) {
      const auto at = static_cast<std::size_t>(i);
      value[at] = (value[at] - value[at - 1]) / (node[at] - node[at - static_cast<std::size_t>(order)]);
    }
  Values power{};
  for (int i = count - 1; i >= 0; --i) {
    for (int n = count - 1; n > 0; --n) {
      const auto at = static_cast<std::size_t>(n);
      power[at] = power[at - 1] - node[static_cast<std::size_t>(i)] * power[at];
    }
    power[0] = value[static_cast<std::size_t>(i)] - node[static_cast<std::size_t>(i)] * power[0];
  }
  return power;
}

}  // namespace

LensCurve::LensCurve(double radius) noexcept {
  coefficients = radius >= 32.0 ? 4 : radius >= 12.0 ? 5 : radius >= 8.0 ? 6 : 8;
  scale = 1.0 / (2.0 * radius * kVoxelSphereRadius);
  const double outer = radius + kVoxelSphereRadius;
  offset = outer * outer * scale;
  // Chebyshev nodes, stretched so that the last is t = 2: what lies wholly inside counts whole.
  const double stretch = 2.0 / (1.0 - std::cos(calibration::kPi * (coefficients - 0.5) / coefficients));
  Values node{}, volume_at{}, cap_at{};
  for (int i = 0; i < coefficients; ++i) {
    const auto at = static_cast<std::size_t>(i);
    node[at] = stretch * (1.0 - std::cos(calibration::kPi * (i + 0.5) / coefficients));
    const double t = node[at], d = std::sqrt((offset - t) / scale);
    const Lens lens = lensOfSpheres(radius, kVoxelSphereRadius, d);
    volume_at[at] = lens.volume / (t * t);
    cap_at[at] = lens.moment / d / (t * t);
  }
  const Values q = interpolated(node, volume_at, coefficients), q_cap = interpolated(node, cap_at, coefficients);
  for (std::size_t i = 0; i < q.size(); ++i) {
    volume[i] = static_cast<float>(q[i]);
    cap[i] = static_cast<float>(q_cap[i]);
  }
}

}  // namespace haptics
