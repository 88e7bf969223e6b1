#include "app/procedure/preparation/filling_outcomes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/procedure/preparation/made_surface.h"

namespace app {
namespace {

constexpr int kHalfByte = 128, kFullByte = 255;
constexpr double kColumn_mm = 0.24;

using assets::Tissue;

bool isCurable(std::uint8_t tissue) {
  return tissue >= static_cast<std::uint8_t>(Tissue::composite_soft) &&
         tissue <= static_cast<std::uint8_t>(Tissue::glass_ionomer);
}
bool isCured(std::uint8_t tissue) {
  return tissue == static_cast<std::uint8_t>(Tissue::composite) ||
         tissue == static_cast<std::uint8_t>(Tissue::glass_ionomer);
}

/// Not a neighbour nor bone; the rim of the tooth may bear no label.
bool isOwn(const Crown& crown, glm::ivec3 ijk) { return crown.isTooth(ijk) || crown.label.voxel(ijk) == 0; }

BoxBytes ownOf(const Crown& crown) {
  BoxBytes own(crown.solid.grid());
  assets::forVoxels(own.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    if (isOwn(crown, ijk)) own.bytes()[v] = crown.solid.bytes()[v];
  });
  return own;
}

std::vector<Increment> incrementsOf(const Crown& crown, const LaidBoxes& filling) {
  struct Sum {
    double laid = 0.0, cured = 0.0, curable = 0.0;
    std::map<std::pair<int, int>, double> columns;
  };
  std::map<int, Sum> sums;
  const assets::VolumeGrid& grid = filling.laid.grid();
  const double voxel_mm3 = grid.voxelVolume_mm3();
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (filling.laid.bytes()[v] == 0) return;
    const double mm3 = filling.laid.bytes()[v] / 255.0 * voxel_mm3;
    const std::uint8_t tissue = filling.tissue.bytes()[v];
    Sum& sum = sums[filling.increment.bytes()[v]];
    sum.laid += mm3;
    if (isCurable(tissue)) sum.curable += mm3;
    if (isCured(tissue)) sum.cured += mm3;
    const glm::dvec3 p = crown.frame.local(grid.centre_P_mm(ijk));
    // Shared out between the four columns around, else a column would hold now more, now fewer voxels.
    const glm::dvec2 column = glm::dvec2(p) / kColumn_mm, low = glm::floor(column), f = column - low;
    for (int n = 0; n < 4; ++n)
      sum.columns[{static_cast<int>(low.x) + (n & 1), static_cast<int>(low.y) + (n >> 1)}] +=
          mm3 * ((n & 1) != 0 ? f.x : 1.0 - f.x) * ((n >> 1) != 0 ? f.y : 1.0 - f.y);
  });
  std::vector<Increment> increments;
  for (const auto& [number, sum] : sums) {
    double most_mm3 = 0.0;
    for (const auto& [column, mm3] : sum.columns) most_mm3 = std::max(most_mm3, mm3);
    increments.push_back({number, sum.laid, most_mm3 / (kColumn_mm * kColumn_mm),
                          sum.curable > 0.0 ? sum.cured / sum.curable : 0.0, sum.curable > 0.5 * sum.laid});
  }
  return increments;
}

}  // namespace

LaidBoxes laidBoxes(const haptics::Filling::Volumes& filling, const assets::VolumeGrid& grid,
                    const assets::VolumeGrid& box) {
  LaidBoxes boxes{BoxBytes(box), BoxBytes(box), BoxBytes(box)};
  const glm::ivec3 low(glm::round(grid.indexFromPoint(box.origin_P_mm)));
  assets::forVoxels(box, [&](glm::ivec3 ijk, std::size_t to) {
    if (!grid.contains(low + ijk)) return;
    const std::size_t from = grid.index(low + ijk);
    boxes.laid.bytes()[to] = filling.laid[from], boxes.tissue.bytes()[to] = filling.tissue[from];
    boxes.increment.bytes()[to] = filling.increment[from];
  });
  return boxes;
}

BoxBytes filledTooth(const BoxBytes& made, const haptics::Filling::Volumes& filling, const assets::VolumeGrid& grid) {
  BoxBytes all = made;
  if (filling.laid.empty()) return all;
  const LaidBoxes boxes = laidBoxes(filling, grid, made.grid());
  for (std::size_t v = 0; v < all.bytes().size(); ++v)
    all.bytes()[v] = static_cast<std::uint8_t>(std::min(kFullByte, all.bytes()[v] + boxes.laid.bytes()[v]));
  return all;
}

FillingMeasure::FillingMeasure(const Crown& intact) : intact_(intact), own_(ownOf(intact)), distance_(own_) {}

FillingOutcomes FillingMeasure::outcomesOf(const BoxBytes& made, const LaidBoxes& filling) const {
  FillingOutcomes outcomes;
  const assets::VolumeGrid& grid = made.grid();
  const double step_mm3 = grid.voxelVolume_mm3() / 255.0;
  BoxBytes all(grid);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const int laid = filling.laid.bytes()[v], tooth = made.bytes()[v], was = intact_.solid.bytes()[v];
    all.bytes()[v] = static_cast<std::uint8_t>(std::min(kFullByte, tooth + laid));
    const int lacks = isOwn(intact_, ijk) ? std::max(0, was - tooth) : 0;
    outcomes.cavity_mm3 += lacks * step_mm3;
    if (laid == 0) return;
    const double mm3 = laid * step_mm3;
    const std::uint8_t tissue = filling.tissue.bytes()[v];
    outcomes.laid_mm3 += mm3;
    outcomes.laid_of_mm3[tissue < assets::kTissueCount ? tissue : 0] += mm3;
    if (isCurable(tissue)) outcomes.curable_mm3 += mm3;
    if (isCured(tissue)) outcomes.cured_mm3 += mm3;
    outcomes.filled_mm3 += std::min(laid, lacks) * step_mm3;
    if (own_.bytes()[v] >= kHalfByte) return;
    const double out_mm = distance_.at_mm(grid.centre_P_mm(ijk));
    if (out_mm <= kLeastOverhang_mm) return;
    outcomes.overhang_mm3 += mm3;
    if (laid >= kHalfByte) outcomes.overhang_mm = std::max(outcomes.overhang_mm, out_mm);
  });
  if (outcomes.laid_mm3 <= 0.0) return outcomes;

  const AirParts air(grid, all.bytes());
  outcomes.voids = voidsBeside(air, grid, all.bytes(), filling.laid.bytes(), kLeastVoid_mm3);
  outcomes.increments = incrementsOf(intact_, filling);

  // The free surface: where filling meets the air outside.
  std::vector<std::pair<double, double>> value_area;
  double sum = 0.0, squares = 0.0;
  forSurface(
      all,
      [&](glm::ivec3 ijk, glm::ivec3 next) {
        return 2 * filling.laid.voxel(ijk) >= all.voxel(ijk) && air.isOutside(next);
      },
      [&](const SurfacePlace& place) {
        const double mm = distance_.at_mm(place.p_P_mm);
        value_area.emplace_back(mm, place.area_mm2);
        outcomes.contour_mm2 += place.area_mm2;
        sum += place.area_mm2 * mm, squares += place.area_mm2 * mm * mm;
      });
  if (outcomes.contour_mm2 <= 0.0) return outcomes;
  outcomes.contour_mean_mm = sum / outcomes.contour_mm2;
  outcomes.contour_rms_mm = std::sqrt(squares / outcomes.contour_mm2);
  outcomes.too_high_mm = std::max(0.0, areaPercentile(value_area, 0.99));
  outcomes.too_low_mm = std::max(0.0, -areaPercentile(value_area, 0.01));
  return outcomes;
}

}  // namespace app
