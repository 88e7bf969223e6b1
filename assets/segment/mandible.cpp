#include "assets/segment/mandible.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "assets/segment/cell_filters.h"
#include "assets/segment/flooding.h"

namespace assets {
namespace {

constexpr float kHardCell_hu = 480.0F, kHardVoxel_hu = 450.0F, kMarrow_hu = -400.0F;
constexpr double kSmooth_mm = 0.3, kClosing_mm = 3.0, kMargin_mm = 4.0;
constexpr std::uint8_t kLower = 1, kOther = 2;

/// Where a point lies to the arch and the bite.
struct JawPlace {
  double angle_rad, outside_mm;  ///< to the arch
  double over_sheet_mm;
  double above_mm, behind_mm;  ///< in the axes of the bite
  double aside_mm;             ///< from the middle
};

bool isLowerSeed(const JawPlace& at) {
  return std::abs(at.angle_rad) < kArchEnd_rad && std::abs(at.outside_mm) < 9.0 && at.over_sheet_mm < -3.0 &&
         at.over_sheet_mm > -26.0;
}

/// What can be no lower jaw, as a head is built.
bool isOtherSeed(const JawPlace& at, bool is_dense, bool has_upper, bool is_one_sided) {
  const bool is_spine = at.behind_mm > 48.0 && at.above_mm > -12.0, is_vault = at.above_mm > 75.0;
  if (is_spine || is_vault) return true;
  if (!has_upper) return false;
  const bool is_tooth =
      is_dense && std::abs(at.angle_rad) < kArchEnd_rad && std::abs(at.outside_mm) < 11.0 && at.over_sheet_mm > 3.0;
  const bool is_palate =
      at.outside_mm < -6.0 && std::abs(at.angle_rad) < 1.57 && at.above_mm > 12.0 && at.behind_mm < 0.0;
  if (is_tooth || is_palate) return true;
  if (is_one_sided) return false;
  const bool is_cheek = at.behind_mm < -4.0 && at.above_mm > 30.0;
  const bool is_base = at.aside_mm < 33.0 && at.above_mm > 24.0;
  const bool is_temporal = at.behind_mm > 42.0 && at.above_mm > 15.0;
  return is_cheek || is_base || is_temporal;
}

/// From the first to the last angle at which both jaws have teeth.
std::array<bool, kArchBins> spanOf(const std::array<bool, kArchBins>& bins) {
  std::array<bool, kArchBins> span{};
  const auto first = std::ranges::find(bins, true);
  if (first == bins.end()) return span;
  std::size_t last = kArchBins - 1;
  while (!bins[last]) --last;
  for (auto bin = static_cast<std::size_t>(first - bins.begin()); bin <= last; ++bin) span[bin] = true;
  return span;
}

/// Cells to voxels; cells end before the last voxels do.
CellMask voxelsOf(const CellMask& mask, glm::ivec3 cells, glm::ivec3 first, glm::ivec3 size, int edge) {
  CellMask out(countIn(size), 0);
  tbb::parallel_for(0, size.z, [&](int k) {
    forVoxels({0, 0, k}, {size.x, size.y, k + 1},
              [&](glm::ivec3 ijk) { out[indexIn(size, ijk)] = mask[indexIn(cells, (first + ijk) / edge)]; });
  });
  return out;
}

}  // namespace

CellMask mandibleCells(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch,
                       const BiteSheet& sheet) {
  const bool has_upper =
      std::ranges::any_of(sheet.has_both, [](bool has) { return has; }) || sheet.upper_dense_mm3 > 200.0;
  const std::array<bool, kArchBins> is_cut = spanOf(sheet.has_both);
  std::vector<std::uint8_t> label(smooth_hu.size(), 0);
  CellMask may_flood(smooth_hu.size(), 0);
  std::vector<std::uint16_t> level(smooth_hu.size(), 0);
  tbb::parallel_for(0, cells.size.z, [&](int k) {
    forVoxels({0, 0, k}, {cells.size.x, cells.size.y, k + 1}, [&](glm::ivec3 ijk) {
      const std::size_t n = cells.index(ijk);
      if (smooth_hu[n] <= kHardCell_hu) return;
      const glm::dvec3 p = cells.centre_P_mm(ijk);
      const double angle = arch.angleOf(p);
      const auto bin = static_cast<std::size_t>(JawArch::binOf(angle));
      const glm::dvec2 bite = sheet.aboveAndBehind_mm(arch, p);
      const JawPlace at{
          angle, arch.outside_mm(p), p.z - sheet.z_P_mm[bin], bite.x, bite.y, std::abs(p.x - arch.centre_P_mm.x)};
      const bool is_sheet = is_cut[bin] && std::abs(angle) < kArchEnd_rad && std::abs(at.outside_mm) < 11.0 &&
                            std::abs(at.over_sheet_mm) < 0.5 * cells.spacing_mm;
      if (is_sheet) return;
      may_flood[n] = 1;
      level[n] = static_cast<std::uint16_t>(127.0F - std::min(127.0F, smooth_hu[n] / 20.0F));
      if (isOtherSeed(at, arch.dense[n] != 0, has_upper, arch.is_one_sided))
        label[n] = kOther;
      else if (isLowerSeed(at))
        label[n] = kLower;
    });
  });
  flood(cells.size, level, may_flood, label);
  for (std::uint8_t& value : label) value = value == kLower ? 1 : 0;
  return largestPiece(cells.size, label);
}

Mandible mandibleIn(const VolumeGrid& scan, const std::vector<std::int16_t>& hounsfield, const VolumeGrid& cells,
                    const CellMask& jaw_cells, int edge) {
  const CellBox tight = boxOfCells(cells.size, jaw_cells);
  const CellBox coarse = tight.grown(static_cast<int>(std::ceil(kMargin_mm / cells.spacing_mm)), cells.size);
  const CellBox fine{coarse.low * edge, glm::min(coarse.end * edge, scan.size)};
  Mandible jaw;
  jaw.grid = {fine.size(), scan.spacing_mm, scan.centre_P_mm(fine.low)};
  jaw.first = fine.low;
  const std::vector<std::int16_t> part = croppedTo(fine, scan.size, hounsfield);
  jaw.hounsfield.assign(part.begin(), part.end());
  jaw.smooth_hu = jaw.hounsfield;
  smoothCells(jaw.grid.size, kSmooth_mm / scan.spacing_mm, jaw.smooth_hu);

  const glm::ivec3 box = coarse.size();
  const CellMask bone = croppedTo(coarse, cells.size, jaw_cells);
  CellMask filled = closedBy(box, bone, kClosing_mm / cells.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) fillHolesAcross(box, axis, filled);
  const CellMask inner = voxelsOf(shrunkByOne(box, filled), box, glm::ivec3(0), jaw.grid.size, edge);
  jaw.hard = voxelsOf(grownByOne(box, bone), box, glm::ivec3(0), jaw.grid.size, edge);
  CellMask solid(jaw.hard.size());
  tbb::parallel_for(std::size_t{0}, solid.size(), [&](std::size_t n) {
    if (jaw.smooth_hu[n] <= kHardVoxel_hu) jaw.hard[n] = 0;
    solid[n] = jaw.hard[n] != 0 || (inner[n] != 0 && jaw.smooth_hu[n] > kMarrow_hu) ? 1 : 0;
  });
  jaw.solid = largestPiece(jaw.grid.size, solid);
  return jaw;
}

}  // namespace assets
