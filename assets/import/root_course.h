// The roots of a labelled tooth: their middles from the cervix to the apex, slice by slice across the tooth's axis; a
// part that divides is a furcation. Tooth frame (assets/tooth_canals.h), mm. Any thread; some 10 ms a tooth.
#pragma once

#include <vector>

#include "assets/ct_volume.h"
#include "assets/tooth_canals.h"

namespace assets {

/// A root, or what roots share, in one slice.
struct RootSlice {
  glm::dvec3 middle_mm{0.0};
  glm::dvec2 half_mm{0.0};  ///< widths from its middle, towards mesial and cheek
};

struct RootCourse {
  std::vector<RootSlice> slices;  ///< from below the cervix down
  std::size_t own = 0;            ///< the first that no other root shares
};

/// The frame by the tooth's axis (import/tooth_axis) and its place in the arch, at the neck: below all enamel but a
/// tenth, or over the pulp's middle where no enamel is labelled.
ToothFrame toothFrame(const CtVolume& ct, int fdi);

/// From mesial to distal; roots shorter than 2.5 mm belong to the one beside.
std::vector<RootCourse> rootCourses(const CtVolume& ct, int fdi, const ToothFrame& frame);

}  // namespace assets
