// The way of a canal through the cells of half a jaw. Where a root lies on it the canal cannot be seen, and what a
// cheapest path does there depends on what a step off the canal costs: a way round through dark marrow, or straight on.
// So it is looked for at several costs, and the way that leaves the canal least and bends least is taken: canals hardly
// bend. Frame P, mm. Any thread but the servo; 0.1 s in cells of 0.7 mm, 1 s at 0.35 mm.
#pragma once

#include <span>
#include <vector>

#include "assets/segment/half_jaw.h"

namespace assets {

/// Cells from one of `from` to one of `to`; empty where no bone joins them.
std::vector<std::size_t> canalWay(const HalfJaw& half, std::span<const std::size_t> from,
                                  std::span<const std::size_t> to);

/// The line through points in turn, found at one cost: while they are under a hand. Empty: no way, or fewer than two.
/// 30 ms for a whole canal in cells of 0.7 mm.
std::vector<glm::dvec3> quickCanal(const HalfJaw& half, std::span<const glm::dvec3> points_P_mm);

/// From a canal's end on through what is as dark as soft tissue to a foramen in the bone's surface, 12 mm at most:
/// forwards and outwards, or upwards and towards the tongue. Points from the end on; empty without a dark way.
enum class Foramen { mental, mandibular };
std::vector<glm::dvec3> wayToForamen(const HalfJaw& half, const glm::dvec3& end_P_mm, Foramen foramen, bool is_right);

/// The jaw's cell nearest to a point within 2 mm; the number of cells: none.
std::size_t boneNear(const HalfJaw& half, const glm::dvec3& p_P_mm);

}  // namespace assets
