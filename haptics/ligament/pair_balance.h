// Energy of a blade and a piece together, its slope and curvature by the twelve coordinates of both: the blade's six
// about its middle, then the piece's about its samples' centre, both along and about the axes of P. mm, N, N mm. Servo
// thread; plain values.
#pragma once

#include "haptics/ligament/piece_drive.h"
#include "haptics/ligament/six.h"

namespace haptics {

struct PairBalance {
  double energy_Nmm = 0.0;
  Twelve gradient{};
  SymmetricTwelve hessian;

  /// What holds one of the two alone: 0 the blade, 1 the piece.
  void add(const Balance& one, std::size_t body) noexcept {
    const std::size_t first = 6 * body;
    energy_Nmm += one.energy_Nmm;
    for (std::size_t row = 0; row < 6; ++row) {
      gradient[first + row] += one.gradient[row];
      for (std::size_t column = row; column < 6; ++column)
        hessian(first + row, first + column) += one.hessian(row, column);
    }
  }

  /// A slope and a curvature along `way`: how a length changes with the coordinates. `bodies` 1: with the blade's
  /// alone.
  void addAlong(const Twelve& way, double slope, double curvature, std::size_t bodies) noexcept {
    const std::size_t end = 6 * bodies;
    for (std::size_t row = 0; row < end; ++row) {
      gradient[row] += slope * way[row];
      const double part = curvature * way[row];
      double* const to = &hessian.upper[SymmetricTwelve::at(row, row)];
      for (std::size_t column = row; column < end; ++column) to[column - row] += part * way[column];
    }
  }
};

/// How far a point of the blade goes along `direction_P` against the same place of the piece, or of P.
inline Twelve wayAlong(const glm::dvec3& direction_P, const glm::dvec3& blade_arm_mm, const glm::dvec3& piece_arm_mm,
                       bool against_piece) noexcept {
  const glm::dvec3 d = direction_P, b = glm::cross(blade_arm_mm, d);
  if (!against_piece) return {d.x, d.y, d.z, b.x, b.y, b.z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const glm::dvec3 q = glm::cross(piece_arm_mm, d);
  return {d.x, d.y, d.z, b.x, b.y, b.z, -d.x, -d.y, -d.z, -q.x, -q.y, -q.z};
}

}  // namespace haptics
