// The bone that was removed against the bone that was planned to go (reference/product 4.2: O3, O4). Volumes by
// fractions of voxels: removed r = before - after, planned p = before inside the plan; both = min(r, p). Over-cut: r
// without p, and how far outside of the plan; under-cut: p without r. Frame P; mm, mm3. Pure; any thread; a pass over
// the voxels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "assets/volume_grid.h"

namespace app {

/// Of a label: what the volumes of bone count.
bool countsAsBone(std::uint8_t label);

struct PlanComparison {
  double removed_mm3 = 0.0, planned_mm3 = 0.0, both_mm3 = 0.0;
  /// Of what was cut outside of the plan, by volume; none: nothing was.
  std::optional<double> over_mean_mm, over_p95_mm, over_max_mm;

  double over_mm3() const { return removed_mm3 - both_mm3; }
  double under_mm3() const { return planned_mm3 - both_mm3; }
  /// 1: the same; none: neither planned nor removed.
  std::optional<double> dice() const;
};

/// `before`, `after`: solid fractions in the order of the grid; `counts`: of a voxel, whether it is bone;
/// `from_plan_mm`: signed distance to the plan, negative inside.
PlanComparison compareWithPlan(const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                               std::span<const std::uint8_t> after, const std::function<bool(std::size_t)>& counts,
                               const std::function<double(const glm::dvec3&)>& from_plan_mm);

/// Of a voxel: how much of it went.
inline double lostShare(std::uint8_t before, std::uint8_t after) {
  return before > after ? (before - after) / 255.0 : 0.0;
}
/// A voxel that lies there: how much of it is within the plan.
inline double shareInPlan(double from_plan_mm, double spacing_mm) {
  return std::clamp(0.5 - from_plan_mm / spacing_mm, 0.0, 1.0);
}
/// Of what went of a voxel outside of the plan: whether it is a cut, and not noise at its surface.
inline bool isOverCut(double outside, double from_plan_mm) {
  constexpr double kCut = 0.5;
  return outside > kCut && from_plan_mm > 0.0;
}
/// How far outside of the plan; `over`: distance and volume of what was cut there, in any order.
void tellOverCut(std::vector<std::pair<double, double>> over, PlanComparison& found);

/// Bone removed in two rehearsals of one case.
struct RemovalDifference {
  double a_mm3 = 0.0, b_mm3 = 0.0, both_mm3 = 0.0;

  double onlyInA_mm3() const { return a_mm3 - both_mm3; }
  double onlyInB_mm3() const { return b_mm3 - both_mm3; }
  /// 1: the same; none: neither removed any.
  std::optional<double> dice() const;
};

/// As compareWithPlan, with what `after_b` lacks in place of a plan.
RemovalDifference compareRemovals(const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                                  std::span<const std::uint8_t> after_a, std::span<const std::uint8_t> after_b,
                                  const std::function<bool(std::size_t)>& counts);

}  // namespace app
