// A bur's head against flat bone: what it shares with a half-space when it is `depth` deep, for any shape and any angle
// of its axis, and back from volume to depth. mm, double. Any thread; no allocation, no throw.
// `cos_axis` is the cosine between +z of T and the face's normal out of the bone; depth counts from the first touch.
// Slices across the axis are segments of circles (closed form), summed over the axis by Gauss's rule between the places
// where the face meets the outline; cost some 0.2 µs (cylinder) to 1 µs (capsule), back to depth under 10 µs.
// Not the sum over voxels (contact/shape_overlap), which knows no flatness.
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

/// Depth at which the head is wholly in.
double fullDepth_mm(const BurShape& shape, double cos_axis) noexcept;

/// The depth at which `shared_mm3` is shared, 0..wholeDepth, to 1e-9 of it.
double flatDepth_mm(const BurShape& shape, double shared_mm3, double cos_axis) noexcept;

/// The same for a volume smeared by a Gaussian of `sigma_mm` in depth, as a sum over voxels is (contact/cap has the
/// sphere's closed form): the depth h whose mean of V(h + sigma xi) is the volume. Begins at 0 with slope 1.
double flatDepth_mm(const BurShape& shape, double shared_mm3, double cos_axis, double sigma_mm) noexcept;

}  // namespace haptics
