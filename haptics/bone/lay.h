// What instruments with a ball at their tip do to a filling: lay material into air, press it aside or ahead. Frame P;
// steps of 1/255 of a voxel, so that sums are exact. The thread that owns the filling; several passes over the blocks
// under the ball: layBall 50 us, packBall 130 us, 300 at most, with 0.5 and 0.7 mm at 0.08 mm; no allocation, no throw.
// Carving: bone/carve. Light: bone/cure.
#pragma once

#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/filling.h"

namespace haptics {

/// A ball over a filling and the tooth around it, on the same grid.
struct LaidBall {
  SolidField tooth;
  Filling& filling;
  calibration::Point<calibration::Patient> centre_P;
  double radius_mm = 0.5;
  std::uint64_t tick = 0;  ///< seed of the rounding
  StrokeHistory* strokes = nullptr;
};

/// Fills air within the ball, by at most `most_steps`, shared out by how much each voxel lacks; nothing unless the ball
/// touches tooth or filling. Returns the steps laid.
std::int64_t layBall(const LaidBall& ball, assets::Tissue material, unsigned increment,
                     std::int64_t most_steps) noexcept;

/// Presses what has not set out of the ball, into air beside it that borders on tooth or filling: `share` of it, as far
/// as there is room. Nothing is lost or made. Returns the steps moved.
std::int64_t packBall(const LaidBall& ball, double share) noexcept;

/// How far ahead of a hot plugger gutta-percha is soft, and how wide: our defaults, after the 3 to 5 mm that are
/// taught.
inline constexpr double kHeated_mm = 4.0, kHeatedRadius_mm = 0.6;
/// The same into air ahead that borders on filling, towards the unit vector `ahead`: what lies between moves on.
std::int64_t packAhead(const LaidBall& ball, const glm::dvec3& ahead, double share) noexcept;

}  // namespace haptics
