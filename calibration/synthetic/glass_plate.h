// Ray optics of a plane-parallel glass plate whose front face is a mirror: transmission, reflection and ghost. Frame W,
// mm, rad. Pure; any thread; some ten flops. Ideal: flat and not wedged. Formulae: Snell's law; shift and ghost as
// reference/calibration 1.2.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/plane.h"
#include "calibration/geometry/pose.h"

namespace calibration {

struct GlassPlate {
  Plane<World> face;  ///< the mirroring face; the normal may point to either side
  double thickness_mm = 3.0;
  double refractive_index = 1.52;
};

struct Ray {
  Point<World> from_W;
  Vector<World> along_W;  ///< unit
};

/// The ray behind the plate.
Ray seenThrough(const GlassPlate& plate, const Ray& ray);

/// The ray after reflection in the mirroring face, or in the far face.
Ray mirrored(const Plane<World>& face, const Ray& ray);
Ray mirroredByFarFace(const GlassPlate& plate, const Ray& ray);

}  // namespace calibration
