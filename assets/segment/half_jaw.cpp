#include "assets/segment/half_jaw.h"

#include <cmath>

#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/tubeness.h"

namespace assets {
namespace {

constexpr double kOverMiddle_mm = 4.0, kOverBite_mm = 12.0, kInside_mm = 1.2, kPathSmooth_mm = 0.35, kTube_mm = 1.1,
                 kCoarseCell_mm = 0.7;
constexpr std::size_t kLeastBone_mm3 = 100;

/// The grid of cells of `edge` voxels, the last ones cut off.
VolumeGrid coarsened(const VolumeGrid& grid, int edge) {
  return {grid.size / edge, grid.spacing_mm * edge,
          grid.origin_P_mm + 0.5 * (edge - 1) * grid.spacing_mm * glm::dvec3(1.0)};
}

/// Means of cells of `edge` values.
template <class Value>
std::vector<float> meansIn(glm::ivec3 size, int edge, const std::vector<Value>& values) {
  const glm::ivec3 cells = size / edge;
  std::vector<float> means;
  means.reserve(countIn(cells));
  forVoxels(glm::ivec3(0), cells, [&](glm::ivec3 cell) {
    float sum = 0.0F;
    forVoxels(edge * cell, edge * (cell + 1),
              [&](glm::ivec3 ijk) { sum += static_cast<float>(values[indexIn(size, ijk)]); });
    means.push_back(sum / static_cast<float>(edge * edge * edge));
  });
  return means;
}

CellMask halfFull(const std::vector<float>& means) {
  CellMask mask(means.size());
  for (std::size_t n = 0; n < mask.size(); ++n) mask[n] = means[n] >= 0.5F ? 1 : 0;
  return mask;
}

template <class Belongs>
std::vector<float> valuesWhere(const std::vector<float>& values, const Belongs& belongs) {
  std::vector<float> some;
  for (std::size_t n = 0; n < values.size(); ++n)
    if (belongs(n)) some.push_back(values[n]);
  return some;
}

}  // namespace

float valueAtShare(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

bool HalfJaw::isUsable() const {
  return static_cast<double>(std::ranges::count(may_hold, std::uint8_t{1})) * grid.voxelVolume_mm3() > kLeastBone_mm3;
}

int coarseEdge(const VolumeGrid& grid) {
  return std::max(1, static_cast<int>(std::lround(kCoarseCell_mm / grid.spacing_mm)));
}

CellBox boxOfHalf(const CanalScene& scene, bool is_right) {
  const JawArch& arch = scene.arch;
  const BiteSheet& sheet = scene.sheet;
  const VolumeGrid& grid = scene.jaw.grid;
  const int middle = static_cast<int>(std::lround(grid.indexFromPoint(glm::dvec3(arch.centre_P_mm, 0.0)).x));
  const int over = static_cast<int>(kOverMiddle_mm / grid.spacing_mm);
  const double back_P_mm = grid.centre_P_mm(grid.size - 1).y;
  const double highest_P_mm = std::max(sheet.height_P_mm, sheet.planeHeight_P_mm(arch, back_P_mm)) + kOverBite_mm;
  const int top = static_cast<int>((highest_P_mm - grid.origin_P_mm.z) / grid.spacing_mm);
  CellBox box{glm::ivec3(0), grid.size};
  is_right ? box.end.x = std::clamp(middle + over, 0, grid.size.x)
           : box.low.x = std::clamp(middle - over, 0, grid.size.x);
  box.end.z = std::clamp(top, 0, grid.size.z);
  return box;
}

HalfJaw boneIn(const CanalScene& scene, const CellBox& box, int edge) {
  const Mandible& jaw = scene.jaw;
  const ToothRegions& teeth = scene.regions;
  const glm::ivec3 size = glm::max(box.size(), glm::ivec3(0));
  const VolumeGrid voxels{size, jaw.grid.spacing_mm, jaw.grid.centre_P_mm(box.low)};
  HalfJaw half;
  half.grid = coarsened(voxels, edge);
  if (box.isEmpty() || half.grid.voxelCount() == 0) return half;
  CellMask tooth(voxels.voxelCount(), 0);
  forCells(teeth.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
    const glm::ivec3 at = teeth.box.low + ijk - box.low;
    if (teeth.part[n] != 0 && voxels.contains(at)) tooth[voxels.index(at)] = 1;
  });
  half.tooth = halfFull(meansIn(size, edge, tooth));
  half.solid = halfFull(meansIn(size, edge, croppedTo(box, jaw.grid.size, jaw.solid)));
  const glm::ivec3 cells = half.grid.size;
  const double spacing_mm = half.grid.spacing_mm;
  CellMask barred(half.solid.size());
  for (std::size_t n = 0; n < barred.size(); ++n) barred[n] = half.solid[n] == 0 ? 1 : 0;
  const std::vector<float> depth_mm = exactDistance_mm(cells, spacing_mm, barred);
  half.may_hold.resize(half.solid.size());
  for (std::size_t n = 0; n < barred.size(); ++n)
    half.may_hold[n] = static_cast<double>(depth_mm[n]) > kInside_mm && half.tooth[n] == 0 ? 1 : 0;
  if (!half.isUsable()) return half;

  half.hounsfield = meansIn(size, edge, croppedTo(box, jaw.grid.size, jaw.hounsfield));
  half.smooth_hu = half.hounsfield;
  const auto holds = [&](std::size_t n) { return half.may_hold[n] != 0; };
  const float usual_hu = valueAtShare(valuesWhere(half.smooth_hu, holds), 0.5);
  for (std::size_t n = 0; n < barred.size(); ++n)
    if (!holds(n)) half.smooth_hu[n] = usual_hu;
  smoothCells(cells, kPathSmooth_mm / spacing_mm, half.smooth_hu);
  return half;
}

HalfJaw halfIn(const CanalScene& scene, const CellBox& box, int edge) {
  HalfJaw half = boneIn(scene, box, edge);
  if (half.smooth_hu.empty()) return half;
  const auto holds = [&](std::size_t n) { return half.may_hold[n] != 0; };
  half.score = darkTubeness(half.grid.size, kTube_mm / half.grid.spacing_mm, half.smooth_hu);
  const float tube = std::max(1.0F, valueAtShare(valuesWhere(half.score, holds), 0.97));
  const float bright_hu = valueAtShare(valuesWhere(half.smooth_hu, holds), 0.75);
  for (std::size_t n = 0; n < half.score.size(); ++n)
    half.score[n] = 0.7F * std::clamp(half.score[n] / tube, 0.0F, 2.0F) +
                    0.5F * std::clamp((bright_hu - half.smooth_hu[n]) / 500.0F, 0.0F, 1.5F);
  return half;
}

}  // namespace assets
