// Dry friction of a file's section on the wall: a bristle along the axis and round it, whose pull never exceeds the
// normal force of the tick before, and edges of flutes that slide more easily along themselves than across:
//   force = -M s, s = k z, |s| <= N, M = [A B; B C] (axis, round) of diag(along, across) turned by the helix angle b,
//   tan b = 2 pi r / lead. Turned clockwise: N (across - along) sin b cos b along the axis screws the file in, against
//   a torque N r (along sin^2 b + across cos^2 b). Source: reference/sisters 1.4.
// A potential along each of the two; the coupling B lags by a tick. Clockwise is seen from the handle: positive about
// the axis towards the tip. N, mm. Pure; any thread; some ns.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace haptics {

struct FluteFriction {
  double axial = 0.0, coupled = 0.0, round = 0.0;  ///< A, B, C
};

inline FluteFriction fluteFriction(double along, double across, double radius_mm, double lead_mm) noexcept {
  const double tangent = 2.0 * std::numbers::pi * radius_mm / lead_mm, square = tangent * tangent;
  const double cosine2 = 1.0 / (1.0 + square), sine2 = square * cosine2;
  return {along * cosine2 + across * sine2, (along - across) * tangent * cosine2, along * sine2 + across * cosine2};
}

/// A bristle's stretch: x along the axis, y round it.
struct Bristle {
  glm::dvec2 mm{0.0};

  /// Sliding: as long as the normal force lets it be.
  glm::dvec2 held(double N_per_mm, double normal_N) const {
    const double stretch = std::sqrt(glm::dot(mm, mm));
    return N_per_mm * stretch > normal_N ? mm * (normal_N / (N_per_mm * stretch)) : mm;
  }
};

/// Energy, pull and slope along one of the two, for a friction of 1.
struct BristlePull {
  double energy_Nmm, N, N_per_mm;
};

inline BristlePull bristlePull(double N_per_mm, double normal_N, double own_mm, double other_mm) noexcept {
  const double stretch2 = own_mm * own_mm + other_mm * other_mm, stretch = std::sqrt(stretch2);
  if (N_per_mm * stretch <= normal_N) return {0.5 * N_per_mm * stretch2, N_per_mm * own_mm, N_per_mm};
  return {normal_N * stretch - 0.5 * normal_N * normal_N / N_per_mm, normal_N * own_mm / stretch,
          normal_N * other_mm * other_mm / (stretch2 * stretch)};
}

}  // namespace haptics
