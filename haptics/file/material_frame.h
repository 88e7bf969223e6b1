// Frames carried along a file: across its axis, turned as little as possible from link to link, and by its roll. Sine
// and cosine by halving the angle: the same bits with any mathematics library. Pure; any thread; some 20 ns.
#pragma once

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace haptics {

inline double lengthOf(const glm::dvec3& v) noexcept { return std::sqrt(glm::dot(v, v)); }
inline glm::dvec3 unitOf(const glm::dvec3& v) noexcept { return v / lengthOf(v); }

/// Across the axis of a hand that holds a file.
inline glm::dvec3 sideOf(const glm::dquat& R_PT) noexcept { return R_PT * glm::dvec3(1.0, 0.0, 0.0); }

/// v, across the unit direction `from`, turned with it to `to`.
inline glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) noexcept {
  const double along = 1.0 + glm::dot(from, to);
  return along < 1e-9 ? v : v - (from + to) * (glm::dot(v, to) / along);
}

/// Cosine and sine.
inline glm::dvec2 turnBy(double angle_rad) noexcept {
  int halved = 0;
  for (; std::fabs(angle_rad) > 0.05 && halved < 40; ++halved) angle_rad *= 0.5;
  const double a2 = angle_rad * angle_rad;
  glm::dvec2 turn(1.0 - a2 / 2.0 * (1.0 - a2 / 12.0 * (1.0 - a2 / 30.0)),
                  angle_rad * (1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0))));
  for (; halved > 0; --halved) turn = {turn.x * turn.x - turn.y * turn.y, 2.0 * turn.x * turn.y};
  return turn;
}

/// About an axis whose length is 2 sin(angle / 2).
inline glm::dmat3 turnOfChord(const glm::dvec3& chord) noexcept {
  const double quarter = 0.25 * glm::dot(chord, chord);
  return glm::mat3_cast(glm::dquat(std::sqrt(quarter < 1.0 ? 1.0 - quarter : 0.0), 0.5 * chord));
}

}  // namespace haptics
