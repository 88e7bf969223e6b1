#include "app/session/measures/original_surface.h"

#include "haptics/body/distance_field.h"

namespace app {

OriginalSurface::OriginalSurface(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid)
    : field_(std::make_unique<haptics::DistanceField>(grid, solid, kBand_mm)) {}
OriginalSurface::~OriginalSurface() = default;

double OriginalSurface::distance_mm(const glm::dvec3& p_P_mm) const { return field_->at_mm(p_P_mm); }

glm::dvec3 OriginalSurface::normalAt(const glm::dvec3& p_P_mm) const {
  const assets::VolumeGrid& grid = field_->grid();
  const glm::dvec3 index = grid.indexFromPoint(p_P_mm);
  if (!(glm::all(glm::greaterThanEqual(index, glm::dvec3(0.0))) &&
        glm::all(glm::lessThanEqual(index, glm::dvec3(grid.size - 1)))))
    return glm::dvec3(0.0);
  // Over a millimetre to either side: the surface's direction, not a voxel's.
  constexpr double kReach_mm = 1.0;
  glm::dvec3 gradient(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = kReach_mm;
    gradient[axis] = field_->at_mm(p_P_mm + step) - field_->at_mm(p_P_mm - step);
  }
  const double length = glm::length(gradient);
  return length > 0.2 * kReach_mm ? gradient / length : glm::dvec3(0.0);
}

}  // namespace app
