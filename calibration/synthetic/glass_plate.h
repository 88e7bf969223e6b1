// A plane-parallel sheet of glass whose front face is a mirror, seen through and reflected in: what it does to a line
// of sight. Frame W, mm, rad. Pure; any thread; some ten flops. Flat and not wedged: real plates are neither quite.
// Formulas: Snell's law; shift and ghost as reference/calibration 1.2.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/plane.h"
#include "calibration/geometry/pose.h"

namespace calibration {

struct GlassPlate {
  Plane<World> face;  ///< the mirroring one; its normal to the side of the eye, or away from it
  double thickness_mm = 3.0;
  double refractive_index = 1.52;
};

struct Ray {
  Point<World> from_W;
  Vector<World> along_W;  ///< unit
};

/// t sin(a) (1 - cos(a) / sqrt(n^2 - sin^2 a)): how far a line that meets the plate at this angle to its normal is
/// moved sideways behind it.
double plateShift_mm(const GlassPlate& plate, double angle_rad);

/// How far apart, across the line of sight, the two images stand that front and far face mirror.
double ghostSpacing_mm(const GlassPlate& plate, double angle_rad);

/// The same line as it goes on behind the plate.
Ray seenThrough(const GlassPlate& plate, const Ray& sight);

/// The same line after the mirroring face, or after the far face and out again.
Ray mirrored(const Plane<World>& face, const Ray& sight);
Ray mirroredByFarFace(const GlassPlate& plate, const Ray& sight);

}  // namespace calibration
