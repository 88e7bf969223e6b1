#include "render/volume/guide_field.h"

#include <algorithm>
#include <cmath>

#include "assets/cut_field.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr double kReach_mm = 4.5;  // larger distances are not drawn
constexpr double kCutReach_mm = 1.5;

std::uint16_t packed(double mm) {
  const double share = (mm - GUIDE_LOW_MM) / (GUIDE_HIGH_MM - GUIDE_LOW_MM);
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

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
    write(glm::min(a, b) - reach_mm, glm::max(a, b) + reach_mm, 0, [&](const glm::dvec3& p) {
      return calibration::distanceToSegment(p, a, b) - guides.mandibular_canal_radius_mm;
    });
  }
  if (guides.cut) {
    const assets::CutField cut(*guides.cut, kCutReach_mm);
    write(cut.low_P_mm(), cut.high_P_mm(), 1, [&](const glm::dvec3& p) { return cut.distance_mm(p); });
  }
  return field;
}

}  // namespace render
