// What guides the surgeon, as distances in the volume: to the mandibular canal and to the bone that is planned to go.
// One coarse field on the cells of the ambient map (AMBIENT_CELL_VOXELS), trilinear, for every back-end to read.
// Frame P, mm. Made once, start-up; some ten milliseconds. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "assets/volume_grid.h"
#include "render/frame.h"
#include "render/volume/bordered_field.h"

namespace render {

/// A cut planned as the sweep of a ball over a rectangle: all that lies nearer to it than the radius.
struct PlannedCut {
  glm::dvec3 middle_P_mm{0.0};                      ///< of the rectangle
  glm::dvec3 along_P{1, 0, 0}, outward_P{0, 0, 1};  ///< its edges, unit, square to each other
  double half_length_mm = 0.0, half_height_mm = 0.0, radius_mm = 0.0;
};

struct Guides {
  std::vector<glm::dvec3> mandibular_canal_P_mm;  ///< centre line; empty: not known
  double mandibular_canal_radius_mm = 1.4;
  std::optional<PlannedCut> cut;
};

/// From a place to the line between two others, in two dimensions or three.
template <class Vector>
double distanceToSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? glm::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

/// Outside the cut: above zero.
double distanceToCut_mm(const PlannedCut& cut, const glm::dvec3& p_P_mm);

/// Per cell: to the canal's wall, to the planned cut; 0 is GUIDE_LOW_MM, 65535 GUIDE_HIGH_MM or beyond.
using GuideField = BorderedField<glm::u16vec2>;

GuideField guideField(const assets::VolumeGrid& grid, const Guides& guides);

/// GUIDE_CLEARANCE, GUIDE_PLAN: what a frame shows of them.
int visibleGuides(const Frame& frame);

}  // namespace render
