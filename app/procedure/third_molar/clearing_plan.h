// The cut that takes away what stands in the way of a piece (procedure/ways_out): from the direction from which most of
// it is reached with little else cut; off the second molar and the mandibular canal. Frame P, mm. Any thread; some
// tenths of a second; allocates.
#pragma once

#include <optional>
#include <span>

#include "app/procedure/third_molar/site_solid.h"

namespace app {

/// `off_tooth_mm`: of the bur from the tooth; below 0 it may be cut too. None: the bur reaches next to nothing of it.
std::optional<assets::PlannedCut> planClearing(const SiteSolid& site, std::span<const glm::dvec3> in_the_way_P_mm,
                                               double bur_radius_mm, double off_tooth_mm, const Margins& margins = {});

}  // namespace app
