#include "render/volume/guide_field.h"

#include <algorithm>
#include <cmath>

#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr double kReach_mm = 4.5;  // larger distances are not drawn

std::uint16_t packed(double mm) {
  const double share = (mm - GUIDE_LOW_MM) / (GUIDE_HIGH_MM - GUIDE_LOW_MM);
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

double distanceToCut_mm(const PlannedCut& cut, const glm::dvec3& p_P_mm) {
  const glm::dvec3 offset = p_P_mm - cut.middle_P_mm;
  const double along = glm::dot(offset, cut.along_P), outward = glm::dot(offset, cut.outward_P);
  const glm::dvec3 nearest = std::clamp(along, -cut.half_length_mm, cut.half_length_mm) * cut.along_P +
                             std::clamp(outward, -cut.half_height_mm, cut.half_height_mm) * cut.outward_P;
  return glm::length(offset - nearest) - cut.radius_mm;
}

int visibleGuides(const Frame& frame) {
  return (frame.layers.clearance ? GUIDE_CLEARANCE : 0) | (frame.layers.planned_cut ? GUIDE_PLAN : 0);
}

GuideField guideField(const assets::VolumeGrid& grid, const Guides& guides) {
  const glm::ivec3 size = (grid.bricks() * assets::kBrickVoxels) / AMBIENT_CELL_VOXELS;
  GuideField field(size);
  forEachIn({glm::ivec3(0), size}, [&](glm::ivec3 cell) { *field.at(cell) = glm::u16vec2(65535); });
  const double cell_mm = AMBIENT_CELL_VOXELS * grid.spacing_mm;
  const glm::dvec3 first_P_mm = grid.origin_P_mm + 0.5 * (AMBIENT_CELL_VOXELS - 1) * grid.spacing_mm;

  // Each shape writes the cells around it; the smallest distance is kept.
  const auto write = [&](const glm::dvec3& low_P_mm, const glm::dvec3& high_P_mm, int channel,
                         const auto& distance_mm) {
    const glm::ivec3 low = glm::max(glm::ivec3(glm::floor((low_P_mm - first_P_mm) / cell_mm)), glm::ivec3(0));
    const glm::ivec3 high = glm::min(glm::ivec3(glm::ceil((high_P_mm - first_P_mm) / cell_mm)), size - 1);
    forEachIn({low, high - low + 1}, [&](glm::ivec3 cell) {
      std::uint16_t& value = (*field.at(cell))[channel];
      value = std::min(value, packed(distance_mm(first_P_mm + cell_mm * glm::dvec3(cell))));
    });
  };
  for (std::size_t n = 0; n + 1 < guides.mandibular_canal_P_mm.size(); ++n) {
    const glm::dvec3 &a = guides.mandibular_canal_P_mm[n], &b = guides.mandibular_canal_P_mm[n + 1];
    const double reach_mm = guides.mandibular_canal_radius_mm + kReach_mm;
    write(glm::min(a, b) - reach_mm, glm::max(a, b) + reach_mm, 0,
          [&](const glm::dvec3& p) { return distanceToSegment(p, a, b) - guides.mandibular_canal_radius_mm; });
  }
  if (guides.cut) {
    const PlannedCut& cut = *guides.cut;
    const double reach_mm = cut.half_length_mm + cut.half_height_mm + cut.radius_mm + kReach_mm;
    write(cut.middle_P_mm - reach_mm, cut.middle_P_mm + reach_mm, 1,
          [&](const glm::dvec3& p) { return distanceToCut_mm(cut, p); });
  }
  return field;
}

}  // namespace render
