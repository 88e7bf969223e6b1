#include "assets/import/tooth_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "assets/import/tooth_axis.h"

namespace assets {
namespace {

constexpr double kSmallest_mm3 = 10.0;
constexpr double kFront_mm = 5.0;

bool isPartOfMarkedTooth(std::uint8_t label) {
  const Tissue tissue{label};
  return tissue == Tissue::enamel || tissue == Tissue::dentine || tissue == Tissue::pulp;
}

bool isHardOfTooth(std::uint8_t label) {
  const Tissue tissue{label};
  return tissue == Tissue::enamel || tissue == Tissue::dentine || tissue == Tissue::other_teeth;
}

struct Mass {
  double count = 0.0;
  glm::dvec3 sum{0.0};
};

/// Voxels, and the sum of their indices from the grid's middle, so that the sums keep their digits.
template <class Belongs>
Mass massOf(const VolumeGrid& grid, const Belongs& belongs) {
  Mass mass;
  std::size_t v = 0;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i, ++v) {
        if (!belongs(v)) continue;
        mass.sum += glm::dvec3(i, j, k) - 0.5 * glm::dvec3(grid.size);
        mass.count += 1.0;
      }
  return mass;
}

glm::dvec3 centroid_P_mm(const VolumeGrid& grid, const Mass& mass) {
  return grid.origin_P_mm + grid.spacing_mm * (mass.sum / mass.count + 0.5 * glm::dvec3(grid.size));
}

/// Mean x of the most anterior 5 mm of a tissue, or NaN.
double frontOf(const CtVolume& ct, Tissue tissue) {
  const VolumeGrid& grid = ct.grid;
  const auto value = static_cast<std::uint8_t>(tissue);
  const int depth = std::max(1, static_cast<int>(std::lround(kFront_mm / grid.spacing_mm)));
  double sum = 0.0;
  double count = 0.0;
  int end = grid.size.y;
  for (int j = 0; j < end; ++j)
    for (int k = 0; k < grid.size.z; ++k)
      for (int i = 0; i < grid.size.x; ++i) {
        if (ct.label[grid.index({i, j, k})] != value) continue;
        end = std::min(end, j + depth);
        sum += i;
        count += 1.0;
      }
  return count > 0.0 ? grid.origin_P_mm.x + grid.spacing_mm * sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void numberThirdMolar(CtVolume& ct) {
  const Mass hard = massOf(
      ct.grid, [&](std::size_t v) { return isPartOfMarkedTooth(ct.label[v]) && Tissue{ct.label[v]} != Tissue::pulp; });
  if (hard.count * ct.grid.voxelVolume_mm3() < kSmallest_mm3) return;
  double front_P_mm = frontOf(ct, Tissue::other_teeth);
  if (std::isnan(front_P_mm)) front_P_mm = frontOf(ct, Tissue::cortical);
  if (std::isnan(front_P_mm)) front_P_mm = ct.grid.centre_P_mm(ct.grid.size / 2).x;
  const int fdi = centroid_P_mm(ct.grid, hard).x < front_P_mm ? 48 : 38;

  ct.tooth.resize(ct.label.size());
  std::ranges::transform(ct.label, ct.tooth.begin(), [fdi](std::uint8_t label) {
    return static_cast<std::uint8_t>(isPartOfMarkedTooth(label) ? fdi : 0);
  });
}

std::map<int, double> toothVolumes_mm3(const CtVolume& ct) {
  std::array<std::size_t, 256> voxels{};
  for (const std::uint8_t fdi : ct.tooth) ++voxels[fdi];
  std::map<int, double> volumes;
  for (std::size_t fdi = 1; fdi < voxels.size(); ++fdi)
    if (voxels[fdi] > 0) volumes[static_cast<int>(fdi)] = static_cast<double>(voxels[fdi]) * ct.grid.voxelVolume_mm3();
  return volumes;
}

std::optional<OperativeSite> siteAtTooth(const CtVolume& ct, int fdi) {
  if (ct.tooth.empty()) return std::nullopt;
  const Mass hard = massOf(ct.grid, [&](std::size_t v) { return ct.tooth[v] == fdi && isHardOfTooth(ct.label[v]); });
  if (hard.count * ct.grid.voxelVolume_mm3() < kSmallest_mm3) return std::nullopt;
  return OperativeSite{fdi, centroid_P_mm(ct.grid, hard), toothAxis_P(ct, fdi)};
}

}  // namespace assets
