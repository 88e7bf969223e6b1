#include "assets/segment/tooth_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/region_graph.h"
#include "assets/segment/thick_parts.h"

namespace assets {
namespace {

constexpr double kRegionSmooth_mm = 0.25, kLeastDensePiece_mm3 = 25.0, kBodyClosing_mm = 0.9, kFillNear_mm = 2.2,
                 kRise_mm = 0.3;
constexpr double kThicknessBlur_cells = 0.5, kDentineShare = 0.8, kHighShare = 0.9;
constexpr int kRegionMargin = 5;
constexpr std::size_t kMostParts = 254;

/// Pieces that are large enough and hold enamel.
CellMask densePieces(const Mandible& jaw, const std::vector<float>& smooth_hu, const GreyLevels& levels) {
  CellMask dense(smooth_hu.size());
  for (std::size_t v = 0; v < dense.size(); ++v)
    dense[v] = jaw.hard[v] != 0 && smooth_hu[v] > levels.tooth_hu() ? 1 : 0;
  const CellPieces pieces = piecesOfCells(jaw.grid.size, dense);
  std::vector<float> most(pieces.cells.size(), 0.0F);
  for (std::size_t v = 0; v < dense.size(); ++v)
    if (dense[v] != 0)
      most[static_cast<std::size_t>(pieces.of[v])] =
          std::max(most[static_cast<std::size_t>(pieces.of[v])], smooth_hu[v]);
  const double least = kLeastDensePiece_mm3 / jaw.grid.voxelVolume_mm3();
  for (std::size_t v = 0; v < dense.size(); ++v) {
    const auto piece = static_cast<std::size_t>(pieces.of[v]);
    if (dense[v] != 0 && (static_cast<double>(pieces.cells[piece]) <= least || most[piece] <= levels.enamel_hu()))
      dense[v] = 0;
  }
  return dense;
}

/// Closed, pulp filled, but nothing far from what is dense.
CellMask bodyOf(glm::ivec3 size, double spacing_mm, const CellMask& dense) {
  CellMask body = closedBy(size, dense, kBodyClosing_mm / spacing_mm);
  fillHolesAcross(size, 2, body);
  const std::vector<float> away_mm = exactDistance_mm(size, spacing_mm, dense);
  for (std::size_t n = 0; n < body.size(); ++n)
    if (away_mm[n] >= kFillNear_mm) body[n] = 0;
  return body;
}

std::vector<float> thicknessOf(glm::ivec3 size, double spacing_mm, const CellMask& body) {
  std::vector<float> thickness = depthInside_mm(size, spacing_mm, body);
  smoothCells(size, kThicknessBlur_cells, thickness);
  return thickness;
}

/// By part: the grey value that a tenth of it exceeds.
std::vector<float> highGreys(const CellPieces& parts, const std::vector<float>& smooth_hu) {
  std::vector<std::vector<float>> greys(parts.cells.size());
  for (std::size_t n = 0; n < parts.of.size(); ++n)
    if (parts.of[n] != 0) greys[static_cast<std::size_t>(parts.of[n])].push_back(smooth_hu[n]);
  std::vector<float> high(parts.cells.size(), 0.0F);
  for (std::size_t part = 1; part < greys.size(); ++part) {
    const auto at = static_cast<std::ptrdiff_t>(kHighShare * static_cast<double>(greys[part].size() - 1));
    std::ranges::nth_element(greys[part], greys[part].begin() + at);
    high[part] = greys[part][static_cast<std::size_t>(at)];
  }
  return high;
}

}  // namespace

std::vector<CellBox> boxesOfParts(const ToothRegions& teeth) {
  const glm::ivec3 size = teeth.box.size();
  std::vector<CellBox> boxes(static_cast<std::size_t>(teeth.count) + 1, noCells(size));
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    if (teeth.part[n] != 0) boxes[teeth.part[n]].take(ijk);
  });
  return boxes;
}

ToothRegions findToothRegions(const Mandible& jaw, const GreyLevels& levels) {
  ToothRegions teeth;
  std::vector<float> smooth_hu = jaw.smooth_hu;
  smoothCells(jaw.grid.size, kRegionSmooth_mm / jaw.grid.spacing_mm, smooth_hu);
  const CellMask dense = densePieces(jaw, smooth_hu, levels);
  teeth.box = boxOfCells(jaw.grid.size, dense);
  if (teeth.box.isEmpty()) return teeth;
  teeth.box = teeth.box.grown(kRegionMargin, jaw.grid.size);
  const glm::ivec3 size = teeth.box.size();
  smooth_hu = croppedTo(teeth.box, jaw.grid.size, smooth_hu);

  const CellMask body = bodyOf(size, jaw.grid.spacing_mm, croppedTo(teeth.box, jaw.grid.size, dense));
  const std::vector<float> thickness = thicknessOf(size, jaw.grid.spacing_mm, body);
  CellPieces parts = thickParts(size, thickness, body, kRise_mm);
  // Parts that never reach the grey of dentine are dense bone.
  const std::vector<float> high = highGreys(parts, smooth_hu);
  const double least_hu = levels.cortical_hu + kDentineShare * (levels.dentine_hu - levels.cortical_hu);
  for (std::int32_t& part : parts.of)
    if (part != 0 && high[static_cast<std::size_t>(part)] < least_hu) part = 0;

  std::vector<RegionPart> graph(parts.cells.size());
  const double voxel_mm3 = jaw.grid.voxelVolume_mm3();
  for (std::size_t n = 0; n < parts.of.size(); ++n) {
    if (parts.of[n] == 0) continue;
    RegionPart& part = graph[static_cast<std::size_t>(parts.of[n])];
    part.peak = std::max(part.peak, static_cast<double>(thickness[n]));
    part.volume_mm3 += voxel_mm3;
    if (smooth_hu[n] > levels.enamel_hu()) part.enamel_mm3 += voxel_mm3;
  }
  const std::vector<std::int32_t> joined = joinedParts(graph, necksBetween(size, thickness, parts.of));

  // Numbered by volume; the order of equal ones is that of their peaks.
  std::vector<double> volume_mm3(graph.size(), 0.0);
  for (std::size_t part = 1; part < graph.size(); ++part)
    volume_mm3[static_cast<std::size_t>(joined[part])] += graph[part].volume_mm3;
  std::vector<std::size_t> by_volume(graph.size());
  std::iota(by_volume.begin(), by_volume.end(), std::size_t{0});
  std::ranges::stable_sort(by_volume, std::greater<>(), [&](std::size_t part) { return volume_mm3[part]; });
  std::vector<std::uint8_t> number(graph.size(), 0);
  for (std::size_t n = 0; n < std::min(kMostParts, by_volume.size()) && volume_mm3[by_volume[n]] > 0.0; ++n)
    number[by_volume[n]] = static_cast<std::uint8_t>(++teeth.count);
  teeth.part.resize(parts.of.size());
  std::ranges::transform(parts.of, teeth.part.begin(), [&](std::int32_t part) {
    return part == 0 ? std::uint8_t{0} : number[static_cast<std::size_t>(joined[static_cast<std::size_t>(part)])];
  });
  return teeth;
}

}  // namespace assets
