#include "assets/import/tooth_site.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/import/tooth_axis.h"

namespace assets {
namespace {

constexpr double kMin_mm3 = 10.0, kMax_mm3 = 3000.0;  // a large molar has 1,200 (Wheeler)
constexpr double kFrontSlab_mm = 5.0;

bool isHardTooth(std::uint8_t label) { return isTooth(label) && isHard(label); }

/// Relative to the grid's centre, for precision.
glm::dvec3 centroid_P_mm(const VolumeGrid& grid, const VoxelSum& voxels) {
  const glm::dvec3 middle = 0.5 * glm::dvec3(grid.size);
  return grid.origin_P_mm + grid.spacing_mm * ((voxels.sum - voxels.count * middle) / voxels.count + middle);
}

/// Centroid of the most anterior 5 mm of a tissue.
std::optional<glm::dvec3> frontOf_P_mm(const CtVolume& ct, Tissue tissue) {
  const VolumeGrid& grid = ct.grid;
  const auto value = static_cast<std::uint8_t>(tissue);
  const int depth = std::max(1, static_cast<int>(std::lround(kFrontSlab_mm / grid.spacing_mm)));
  VoxelSum front;
  int end = grid.size.y;
  for (int j = 0; j < end; ++j)
    for (int k = 0; k < grid.size.z; ++k)
      for (int i = 0; i < grid.size.x; ++i) {
        if (ct.label[grid.index({i, j, k})] != value) continue;
        end = std::min(end, j + depth);
        front.sum += glm::dvec3(i, j, k);
        front.count += 1.0;
      }
  return front.count > 0.0 ? std::optional(centroid_P_mm(grid, front)) : std::nullopt;
}

/// 48 or 38, by the teeth or bone in front of the tooth.
std::optional<int> thirdMolarAt(const CtVolume& ct, const glm::dvec3& tooth_P_mm) {
  for (const Tissue tissue : {Tissue::other_teeth, Tissue::cortical})
    if (const auto front_P_mm = frontOf_P_mm(ct, tissue); front_P_mm && front_P_mm->y < tooth_P_mm.y - kFrontSlab_mm)
      return tooth_P_mm.x < front_P_mm->x ? 48 : 38;
  return std::nullopt;
}

}  // namespace

std::array<std::size_t, 256> countsOf(std::span<const std::uint8_t> values) {
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t value : values) ++count[value];
  return count;
}

double labelledTeeth_mm3(const CtVolume& ct) {
  return static_cast<double>(std::ranges::count_if(ct.label, isToothPart)) * ct.grid.voxelVolume_mm3();
}

ThirdMolar numberThirdMolar(CtVolume& ct, const std::optional<int>& requested_fdi) {
  const VoxelSum hard =
      voxelSum(ct.grid, [&](std::size_t v) { return isToothPart(ct.label[v]) && isHard(ct.label[v]); });
  if (hard.count * ct.grid.voxelVolume_mm3() < kMin_mm3) return ThirdMolar::none;
  if (labelledTeeth_mm3(ct) > kMax_mm3) return ThirdMolar::too_large;
  std::optional<int> fdi = thirdMolarAt(ct, centroid_P_mm(ct.grid, hard));
  if (!fdi && (requested_fdi == 48 || requested_fdi == 38)) fdi = requested_fdi;
  if (!fdi) return ThirdMolar::of_unknown_side;

  numberSingleTooth(ct, *fdi);
  return ThirdMolar::numbered;
}

std::map<int, double> toothVolumes_mm3(const CtVolume& ct) {
  const std::array<std::size_t, 256> voxels = countsOf(ct.tooth);
  std::map<int, double> volumes;
  for (std::size_t fdi = 1; fdi < voxels.size(); ++fdi)
    if (voxels[fdi] > 0) volumes[static_cast<int>(fdi)] = static_cast<double>(voxels[fdi]) * ct.grid.voxelVolume_mm3();
  return volumes;
}

std::vector<int> siteCandidates(const CtVolume& ct) {
  std::array<std::size_t, 256> hard_voxels{};
  for (std::size_t v = 0; v < ct.tooth.size(); ++v)
    if (isHardTooth(ct.label[v])) ++hard_voxels[ct.tooth[v]];
  std::vector<int> teeth;
  for (std::size_t fdi = 1; fdi < hard_voxels.size(); ++fdi)
    if (static_cast<double>(hard_voxels[fdi]) * ct.grid.voxelVolume_mm3() >= kMin_mm3)
      teeth.push_back(static_cast<int>(fdi));
  return teeth;
}

std::optional<OperativeSite> siteAtTooth(const CtVolume& ct, int fdi) {
  if (ct.tooth.empty()) return std::nullopt;
  const VoxelSum hard =
      voxelSum(ct.grid, [&](std::size_t v) { return ct.tooth[v] == fdi && isHardTooth(ct.label[v]); });
  if (hard.count * ct.grid.voxelVolume_mm3() < kMin_mm3) return std::nullopt;
  return OperativeSite{fdi, centroid_P_mm(ct.grid, hard), toothAxis_P(ct, fdi)};
}

}  // namespace assets
