// A voxel as a sphere of its volume (Agus et al. 2002): its overlap with a spherical bur has a closed form and hardly
// depends on the lattice. Any unit of length; double. Any thread; about 30 flops. Sources: lens volume and first moment
// of two spheres, reference/physics 2.3; lattice error 9x below point sampling, 2.6.
#pragma once

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {

/// Radius of the sphere with the volume of a voxel of edge 1: (3 / 4 pi)^(1/3).
inline constexpr double kVoxelSphereRadius = 0.62035049089940001667;

struct Lens {
  double volume = 0.0;
  double moment = 0.0;  ///< of the lens about the bur's centre, along the line to the other centre
};

/// Overlap of a bur of radius `bur` and a sphere of radius `ball` at distance `d`.
inline Lens lensOfSpheres(double bur, double ball, double d) {
  const double outer = bur + ball, inner = bur - ball;
  if (d >= outer) return {};
  if (d <= std::abs(inner)) {
    const double smaller = std::min(bur, ball);
    const double volume = 4.0 / 3.0 * calibration::kPi * smaller * smaller * smaller;
    return {volume, inner >= 0.0 ? d * volume : 0.0};
  }
  // The moments of the two caps about the radical plane cancel; d times the ball's cap on the bur's side remains.
  const double gap = outer - d;
  const double volume = calibration::kPi * gap * gap * (d * d + 2.0 * d * outer - 3.0 * inner * inner) / (12.0 * d);
  const double height = ball - (d * d - bur * bur + ball * ball) / (2.0 * d);
  return {volume, d * calibration::kPi * height * height * (3.0 * ball - height) / 3.0};
}

}  // namespace haptics
