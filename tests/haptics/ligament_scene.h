// Roots for tests of the ligament: a cylinder without ends, and two tapered roots as in reference/extraction 3.3.
// mm; origin at the alveolar crest, z up.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "haptics/ligament/piece_hold.h"

namespace haptics::phantom {

inline void addRing(std::vector<SamplePoint>& points, const glm::dvec3& middle, double radius, double area_mm2,
                    double spacing_mm, double phase, double lean, double width_mm) {
  const int count = std::max(6, static_cast<int>(std::lround(2.0 * std::numbers::pi * radius / spacing_mm)));
  for (int n = 0; n < count; ++n) {
    const double angle = 2.0 * std::numbers::pi * (n + phase) / count;
    const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
    points.push_back({.p_Q_mm = middle + radius * out,
                      .outward = glm::normalize(out + glm::dvec3(0.0, 0.0, -lean)),
                      .area_mm2 = area_mm2 / count,
                      .width_mm = width_mm,
                      .has_ligament = true});
  }
}

inline std::vector<SamplePoint> cylinder(double radius_mm, double length_mm, double spacing_mm, double width_mm) {
  std::vector<SamplePoint> points;
  const int rings = static_cast<int>(std::lround(length_mm / spacing_mm));
  const double ring_mm2 = 2.0 * std::numbers::pi * radius_mm * length_mm / rings;
  for (int n = 0; n < rings; ++n)
    addRing(points, {0.0, 0.0, length_mm * ((n + 0.5) / rings - 0.5)}, radius_mm, ring_mm2, spacing_mm, 0.0, 0.0,
            width_mm);
  return points;
}

/// From 2.5 mm radius at the crest to 0.9 mm at 11 mm depth, rounded at the tip; 5.2 mm apart.
inline std::vector<SamplePoint> twoRoots(double spacing_mm, double width_mm = 0.2) {
  constexpr double kLength_mm = 11.0, kTop_mm = 2.5, kTip_mm = 0.9;
  std::vector<SamplePoint> points;
  const double lean = (kTop_mm - kTip_mm) / kLength_mm, slant = std::hypot(1.0, lean);
  for (const double side : {-2.6, 2.6}) {
    const int rings = static_cast<int>(std::lround(kLength_mm * slant / spacing_mm));
    for (int n = 0; n < rings; ++n) {
      const double share = (n + 0.5) / rings, radius = kTop_mm + (kTip_mm - kTop_mm) * share;
      addRing(points, {side, 0.0, -kLength_mm * share}, radius,
              2.0 * std::numbers::pi * radius * kLength_mm * slant / rings, spacing_mm, 0.5 * (n & 1), lean, width_mm);
    }
    const int caps = std::max(1, static_cast<int>(std::lround(kTip_mm / spacing_mm)));
    for (int n = 0; n < caps; ++n) {
      const double from = 0.5 * std::numbers::pi * n / caps, to = 0.5 * std::numbers::pi * (n + 1) / caps;
      const double angle = 0.5 * (from + to);
      addRing(points, {side, 0.0, -kLength_mm - kTip_mm * std::cos(angle)}, kTip_mm * std::sin(angle),
              2.0 * std::numbers::pi * kTip_mm * kTip_mm * (std::cos(from) - std::cos(to)), spacing_mm, 0.0,
              std::cos(angle) / std::sin(angle), width_mm);
    }
  }
  return points;
}

/// A hold that pulls towards z without a turn.
inline PieceDrive pulledUp(double to_mm, double N_per_mm = 5e3, double Nmm_per_rad = 1e7) {
  PieceDrive drive;
  drive.spring.stiffness_N_per_mm = N_per_mm;
  drive.spring.stiffness_Nmm_per_rad = Nmm_per_rad;
  drive.spring.target_X_PQ.translation_mm.z = to_mm;
  return drive;
}

}  // namespace haptics::phantom
