#include "assets/import/divided_teeth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "assets/segment/cell_filters.h"
#include "assets/segment/jaw_arch.h"
#include "assets/segment/thick_parts.h"
#include "assets/segment/tooth_numbers.h"
#include "assets/tissue.h"

namespace assets {
namespace {

constexpr double kLeastRise_mm = 0.25, kMostRise_mm = 0.8, kRiseStep_mm = 0.05, kLeastTooth_mm3 = 80.0;
constexpr std::ptrdiff_t kMostTeeth = 16;
constexpr double kCell_mm = 0.7, kCellSmooth_mm = 0.6;

/// Parts too small for a tooth become part of what they touch most thickly.
void joinCrumbs(glm::ivec3 size, const std::vector<float>& thickness, std::size_t least_cells, CellPieces& parts) {
  for (;;) {
    std::int32_t crumb = 0, to = 0;
    float thickest = -1.0F;
    for (const auto& [sides, neck] : necksBetween(size, thickness, parts.of)) {
      const auto [a, b] = sides;
      const bool a_is_less = parts.cells[static_cast<std::size_t>(a)] < parts.cells[static_cast<std::size_t>(b)];
      const std::int32_t less = a_is_less ? a : b;
      if (parts.cells[static_cast<std::size_t>(less)] >= least_cells || neck <= thickest) continue;
      thickest = neck, crumb = less, to = a_is_less ? b : a;
    }
    if (crumb == 0) return;
    std::ranges::replace(parts.of, crumb, to);
    parts.cells[static_cast<std::size_t>(to)] += parts.cells[static_cast<std::size_t>(crumb)];
    parts.cells[static_cast<std::size_t>(crumb)] = 0;
  }
}

std::optional<JawArch> archOf(const CtVolume& ct) {
  const int edge = std::max(1, static_cast<int>(std::lround(kCell_mm / ct.grid.spacing_mm)));
  const VolumeGrid cells = meanGrid(ct.grid, edge);
  std::vector<float> smooth_hu = meansOfCubes(ct.grid, ct.hounsfield, edge);
  smoothCells(cells.size, kCellSmooth_mm / cells.spacing_mm, smooth_hu);
  return findJawArch(cells, smooth_hu);
}

}  // namespace

std::size_t divideLabelledTeeth(CtVolume& ct) {
  CellMask whole(ct.label.size());
  std::ranges::transform(ct.label, whole.begin(), [](std::uint8_t label) -> std::uint8_t {
    return Tissue{label} == Tissue::other_teeth ? 1 : 0;
  });
  const CellBox box = boxOfCells(ct.grid.size, whole).grown(1, ct.grid.size);
  if (box.isEmpty()) return 0;
  const std::optional<JawArch> arch = archOf(ct);
  if (!arch) return 0;
  const glm::ivec3 size = box.size();
  const CellMask mask = croppedTo(box, ct.grid.size, whole);
  const std::vector<float> thickness = depthInside_mm(size, ct.grid.spacing_mm, mask);
  const auto least_cells = static_cast<std::size_t>(kLeastTooth_mm3 / ct.grid.voxelVolume_mm3());
  CellPieces parts;
  for (double rise_mm = kLeastRise_mm; rise_mm < kMostRise_mm; rise_mm += kRiseStep_mm) {
    parts = thickParts(size, thickness, mask, rise_mm);
    joinCrumbs(size, thickness, least_cells, parts);
    if (std::ranges::count_if(parts.cells, [&](std::size_t n) { return n >= least_cells; }) <= kMostTeeth) break;
  }
  std::vector<FoundTooth> teeth;
  std::vector<glm::dvec3> sum(parts.cells.size(), glm::dvec3(0.0));
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    if (parts.of[n] != 0) sum[static_cast<std::size_t>(parts.of[n])] += ct.grid.centre_P_mm(box.low + ijk);
  });
  for (std::size_t part = 1; part < parts.cells.size(); ++part) {
    if (parts.cells[part] < least_cells) continue;
    FoundTooth tooth;
    tooth.part = static_cast<int>(part);
    tooth.volume_mm3 = static_cast<double>(parts.cells[part]) * ct.grid.voxelVolume_mm3();
    tooth.centre_P_mm = sum[part] / static_cast<double>(parts.cells[part]);
    teeth.push_back(tooth);
  }
  numberTeeth(*arch, teeth);
  std::vector<std::uint8_t> number(parts.cells.size(), 0);
  for (const FoundTooth& tooth : teeth)
    number[static_cast<std::size_t>(tooth.part)] = static_cast<std::uint8_t>(tooth.fdi);
  ct.tooth.resize(ct.label.size(), 0);
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    if (parts.of[n] != 0) ct.tooth[ct.grid.index(box.low + ijk)] = number[static_cast<std::size_t>(parts.of[n])];
  });
  return static_cast<std::size_t>(std::ranges::count_if(teeth, [](const FoundTooth& tooth) { return tooth.fdi != 0; }));
}

}  // namespace assets
