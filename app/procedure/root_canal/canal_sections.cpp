#include "app/procedure/root_canal/canal_sections.h"

#include <cmath>

namespace app {

const CanalSection& CanalSections::at(double from_foramen_mm) {
  auto found = kept_.find(from_foramen_mm);
  if (found == kept_.end())
    found = kept_.emplace(from_foramen_mm, Kept{sectionBefore(before_, canal_, furcation_P_, from_foramen_mm), false})
                .first;
  Kept& kept = found->second;
  if (!kept.is_known) measureAfter(kept.section, before_, after_);
  kept.is_known = true;
  return kept.section;
}

bool CanalSections::forget(std::span<const glm::ivec3> blocks) {
  const assets::VolumeGrid& grid = before_.grid();
  // A sample reads the voxels around it.
  const double half_mm = std::sqrt(3.0) * (0.5 * FineSolid::kEdge + 1.0) * grid.spacing_mm;
  bool any = false;
  for (auto& [from_foramen_mm, kept] : kept_) {
    for (std::size_t n = 0; n < blocks.size() && kept.is_known; ++n) {
      const glm::dvec3 middle_P =
          grid.centre_P_mm(FineSolid::kEdge * blocks[n]) + 0.5 * (FineSolid::kEdge - 1) * grid.spacing_mm;
      const glm::dvec3 away = middle_P - kept.section.centre_P_mm;
      const double reach_mm = kept.section.read_mm + half_mm;
      // In its plane, and within its reach.
      const double aside_mm = glm::dot(away, glm::cross(kept.section.furcation_P, kept.section.aside_P));
      if (glm::dot(away, away) < reach_mm * reach_mm && std::fabs(aside_mm) < half_mm) kept.is_known = false;
    }
    any = any || !kept.is_known;
  }
  return any;
}

}  // namespace app
