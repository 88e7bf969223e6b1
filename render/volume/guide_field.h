// Guides as distances in the volume: to the mandibular canal and to the planned cut. One coarse field on the cells of
// the ambient map (AMBIENT_CELL_VOXELS), sampled trilinearly by every back-end. Frame P, mm. Built once at start-up,
// some ten ms. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "assets/planned_cut.h"
#include "assets/volume_grid.h"
#include "render/frame.h"
#include "render/volume/bordered_field.h"

namespace render {

struct Guides {
  std::vector<glm::dvec3> mandibular_canal_P_mm;  ///< centre line; empty: not known
  double mandibular_canal_radius_mm = 1.4;
  std::optional<assets::PlannedCut> cut;
};

/// From point `p` to segment ab, in two or three dimensions.
template <class Vector>
double distanceToSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? glm::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

/// Per cell: distance to the canal wall and to the planned cut; 0 is GUIDE_LOW_MM, 65535 GUIDE_HIGH_MM or more.
using GuideField = BorderedField<glm::u16vec2>;

GuideField guideField(const assets::VolumeGrid& grid, const Guides& guides);

/// The guides that a frame shows, as GUIDE_ bits.
int visibleGuides(const Frame& frame);

}  // namespace render
