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

double lost(std::uint8_t before, std::uint8_t after) { return before > after ? (before - after) / 255.0 : 0.0; }

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
    const double a = lost(before[v], after_a[v]), b = lost(before[v], after_b[v]);
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
  // Half a voxel or less of one cell is noise at its surface, not a cut.
  constexpr double kCut = 0.5;
  const double h = grid.spacing_mm, voxel_mm3 = h * h * h;
  PlanComparison found;
  std::vector<std::pair<double, double>> over;  // distance, volume
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (before[v] == 0 || !counts(v)) return;
    const double distance_mm = from_plan_mm(grid.centre_P_mm(ijk));
    const double inside = std::clamp(0.5 - distance_mm / h, 0.0, 1.0);
    const double removed = lost(before[v], after[v]);
    const double planned = inside * before[v] / 255.0, both = std::min(removed, planned);
    found.removed_mm3 += removed * voxel_mm3;
    found.planned_mm3 += planned * voxel_mm3;
    found.both_mm3 += both * voxel_mm3;
    if (removed - both > kCut && distance_mm > 0.0) over.emplace_back(distance_mm + 0.5 * h, removed - both);
  });
  if (over.empty()) return found;
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
  return found;
}

}  // namespace app
