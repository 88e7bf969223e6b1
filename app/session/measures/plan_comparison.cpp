#include "app/session/measures/plan_comparison.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "assets/tissue.h"

namespace app {

namespace {

std::optional<double> diceOf(double a, double b, double both) {
  return a + b > 0.0 ? std::optional(2.0 * both / (a + b)) : std::nullopt;
}

}  // namespace

bool countsAsBone(std::uint8_t label) { return assets::isHard(label) && !assets::isTooth(label); }

std::optional<double> PlanComparison::dice() const { return diceOf(removed_mm3, planned_mm3, both_mm3); }
std::optional<double> RemovalDifference::dice() const { return diceOf(a_mm3, b_mm3, both_mm3); }

RemovalDifference compareRemovals(const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                                  std::span<const std::uint8_t> after_a, std::span<const std::uint8_t> after_b,
                                  const std::function<bool(std::size_t)>& counts) {
  const double voxel_mm3 = grid.spacing_mm * grid.spacing_mm * grid.spacing_mm;
  RemovalDifference found;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const double a = lostShare(before[v], after_a[v]), b = lostShare(before[v], after_b[v]);
    if ((a == 0.0 && b == 0.0) || !counts(v)) continue;
    found.a_mm3 += a * voxel_mm3;
    found.b_mm3 += b * voxel_mm3;
    found.both_mm3 += std::min(a, b) * voxel_mm3;
  }
  return found;
}

PlanComparison compareWithPlan(const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                               std::span<const std::uint8_t> after, const std::function<bool(std::size_t)>& counts,
                               const std::function<double(const glm::dvec3&)>& from_plan_mm) {
  const double h = grid.spacing_mm, voxel_mm3 = h * h * h;
  PlanComparison found;
  std::vector<std::pair<double, double>> over;  // distance, volume
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (before[v] == 0 || !counts(v)) return;
    const double distance_mm = from_plan_mm(grid.centre_P_mm(ijk));
    const double inside = shareInPlan(distance_mm, h);
    const double removed = lostShare(before[v], after[v]);
    const double planned = inside * before[v] / 255.0, both = std::min(removed, planned);
    found.removed_mm3 += removed * voxel_mm3;
    found.planned_mm3 += planned * voxel_mm3;
    found.both_mm3 += both * voxel_mm3;
    if (isOverCut(removed - both, distance_mm)) over.emplace_back(distance_mm + 0.5 * h, removed - both);
  });
  tellOverCut(std::move(over), found);
  return found;
}

void tellOverCut(std::vector<std::pair<double, double>> over, PlanComparison& found) {
  if (over.empty()) return;
  std::ranges::sort(over);
  double volume = 0.0, sum = 0.0;
  for (const auto& [distance_mm, part] : over) volume += part, sum += part * distance_mm;
  found.over_mean_mm = sum / volume;
  found.over_max_mm = over.back().first;
  double until = 0.0;
  for (const auto& [distance_mm, part] : over) {
    found.over_p95_mm = distance_mm;
    if ((until += part) >= 0.95 * volume) break;
  }
}

}  // namespace app
