// Measures of a treated tooth from two whole fields, as TreatmentMeter makes them of what has changed.
#pragma once

#include <vector>

#include "app/procedure/root_canal/access_outcomes.h"
#include "app/procedure/root_canal/canal_outcomes.h"

namespace app::shapes {

inline CanalOutcomes outcomesAtOnce(const ToothBlocks& before, const FineSolid& after,
                                    const std::vector<assets::ToothCanal>& canals, std::size_t canal,
                                    const glm::dvec3& furcation_P) {
  std::vector<double> removed_mm3(canals.size());
  removedOfCanals(before, after, canals, changedBlocks(before, after), removed_mm3);
  CanalSections sections(before, after, canals[canal], furcation_P);
  return canalOutcomes(sections, removed_mm3[canal]);
}

inline LostTissue lostAtOnce(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanals& tooth) {
  return lostTissue(before, after, tooth, changedBlocks(before, after));
}

}  // namespace app::shapes
