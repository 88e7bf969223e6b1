// The working ends of elevators: a blade, which is a convex outline of even thickness (or width) with rounded edges,
// and a round shank behind it. Frame T, mm: +z along the shaft, away from the tip, as for every tool; y the concave
// face. Straight: origin at the tip, x across the blade. Cryer: origin on the shaft's axis, level with the tip, which
// lies 8.9 mm towards -x (left) or +x (right), so that a turn of the handle sweeps it. Plain values; any thread;
// distance 40 ns. Sizes: reference/extraction 5.1, unverified: none was measured on an instrument.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "haptics/tool/elevator_kind.h"

namespace haptics {

struct ElevatorShape {
  static constexpr int kCorners = 4, kMostPoints = 32;

  /// Of the blade's core, the edges' radius within the blade: corners about the outline's plane, counter-clockwise.
  /// Straight: (y, z), as wide along x as half_mm says. Cryer: (z, x), as thick along y; its first two corners
  /// coincide in the tip.
  std::array<glm::dvec2, kCorners> corner_mm{};
  int across = 0;  ///< axis of half_mm: 0 or 1
  double half_mm = 0.0;
  double edge_radius_mm = 0.0;

  double shank_radius_mm = 0.0, shank_from_mm = 0.0, shank_to_mm = 0.0;  ///< middles of its round ends, along z

  /// Balls along both long edges of each face, at the tip and along the shank.
  std::array<glm::dvec3, kMostPoints> point_T_mm{};
  std::array<double, kMostPoints> point_radius_mm{};
  int points = 0;
  glm::dvec3 middle_T_mm{0.0};  ///< of the blade
  double reach_mm = 0.0;        ///< no part of the blade is farther from the middle

  struct Distance {
    double mm = 0.0;      ///< below zero inside
    glm::dvec3 out{0.0};  ///< unit, its gradient
  };
  /// To the surface of blade and shank.
  Distance distanceAt(const glm::dvec3& p_T_mm) const noexcept;
};

/// `none` has the shape of a straight 301. 1 µs.
ElevatorShape elevatorShape(ElevatorKind kind) noexcept;

}  // namespace haptics
