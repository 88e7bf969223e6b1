// A bur's head against flat bone: its overlap with a half-space at a depth, for any shape and axis angle, and back from
// volume to depth. mm, double. Any thread; no allocation, no throw. `cos_axis` is the cosine between +z of T and the
// face's normal out of the bone; depth counts from first touch. Slices across the axis are circle segments (closed
// form), summed along the axis by Gauss's rule between the crossings of face and profile. About 0.2 µs (cylinder) to 1
// µs (capsule), back to depth under 10 µs. Sum over voxels: contact/shape_overlap.
#pragma once

#include "haptics/tool/bur_shape.h"

namespace haptics {

struct FlatOverlap {
  double volume_mm3 = 0.0;
  double area_mm2 = 0.0;            ///< of the face inside the head: dV/ddepth
  double centroid_across_mm = 0.0;  ///< of the shared part from T's origin, across the axis on the normal's side
  double centroid_along_mm = 0.0;   ///< along +z
};

FlatOverlap flatOverlap(const BurShape& shape, double depth_mm, double cos_axis) noexcept;

/// Depth at which the head is wholly immersed.
double fullDepth_mm(const BurShape& shape, double cos_axis) noexcept;

/// The depth at which `shared_mm3` is shared, 0..fullDepth, to 1e-9 of it. With `sigma_mm` the volume is smeared by a
/// Gaussian in depth, as a sum over voxels is (contact/cap has the sphere's closed form): the depth h at which the mean
/// of V(h + sigma xi) is the volume. Begins at 0 with slope 1.
double flatDepth_mm(const BurShape& shape, double shared_mm3, double cos_axis, double sigma_mm = 0.0) noexcept;

}  // namespace haptics
