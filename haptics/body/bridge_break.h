// Where a piece of tooth parts when its bridge breaks: along the plane of the bridge, a voxel to the side its centre is
// on, and the bytes of voxels that the break runs through in the ratio of their volumes. What stays is the difference,
// so no solid is lost or made. A bridge more than kCleanBreak_mm thick breaks incompletely: from the floor of the slot
// on the break turns 15 degrees for each mm beyond, at most 45, into the crown, and what lies under it stays on the
// root as a spur. The root is the side with less enamel. Source: reference/extraction 6; the numbers are our defaults.
// Frame and mm of the grid. Any thread, not the servo's; 20-60 ms for a tooth; allocates. The same bytes, labels and
// bridge give the same plan, so that a replay can make it again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "haptics/body/break_plan.h"
#include "haptics/body/components.h"

namespace haptics {

inline constexpr double kCleanBreak_mm = 3.0;

/// Share of a unit cube, centred on the origin, on the side of a plane where n x <= distance. Exact; n is unit, in
/// units of the cube's edge. Source: Scardovelli & Zaleski, J. Comput. Phys. 164, 2000.
double cubeShareBelow(const glm::dvec3& n, double distance);

/// `components`: in one piece, chips aside. `label`: assets::Tissue in the order of the grid, or empty. None: the plane
/// does not part the piece, or the bridge is none (also of values that are not finite).
std::optional<BreakPlan> breakPlan(const Components& components, std::span<const std::uint8_t> label,
                                   const Bridge& bridge);

}  // namespace haptics
