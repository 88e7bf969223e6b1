#include "assets/segment/tooth_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/flooding.h"

namespace assets {
namespace {

constexpr double kReach_mm = 0.8, kThinReach_mm = 1.2, kSlack_mm = 1.0, kGradientBlur_cells = 0.5;
constexpr float kPerLevel_hu = 1.0F, kMostLevel = 4000.0F;
constexpr std::uint8_t kOutside = 255;

/// What of a region is too thin to have a core: no cell of it lies in the core's neighbourhood of 26.
CellMask thinCells(glm::ivec3 size, const std::vector<std::uint8_t>& label, std::uint8_t part, const CellMask& core) {
  CellMask thin(label.size(), 0);
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    if (label[n] != part || core[n] != 0) return;
    bool is_by_core = false;
    forVoxels(glm::max(ijk - 1, glm::ivec3(0)), glm::min(ijk + 2, size),
              [&](glm::ivec3 near) { is_by_core = is_by_core || core[indexIn(size, near)] != 0; });
    thin[n] = is_by_core ? 0 : 1;
  });
  return thin;
}

/// `label`: the regions in a box of the jaw.
CellMask cellsOf(const Mandible& jaw, const CellBox& box, std::uint8_t part, std::vector<std::uint8_t> label) {
  const glm::ivec3 size = box.size();
  const std::vector<float> away_mm = exactDistance_mm(size, jaw.grid.spacing_mm, label);
  CellMask core = shrunkByOne(size, label);
  // Ends of roots: without a core of their own they would be flooded from outside.
  const CellMask thin = thinCells(size, label, part, core);
  const std::vector<float> from_thin_mm = exactDistance_mm(size, jaw.grid.spacing_mm, thin);
  for (std::size_t n = 0; n < core.size(); ++n) core[n] = std::max(core[n], thin[n]);
  const std::vector<float> gradient =
      gradientOfCells(size, kGradientBlur_cells, croppedTo(box, jaw.grid.size, jaw.hounsfield));
  std::vector<std::uint16_t> level(label.size());
  CellMask may_flood(label.size());
  for (std::size_t n = 0; n < label.size(); ++n) {
    level[n] = static_cast<std::uint16_t>(std::min(kMostLevel, gradient[n] / kPerLevel_hu));
    // What was seen of a thin root is thinner than it is.
    const bool is_far = away_mm[n] > kReach_mm && from_thin_mm[n] > kThinReach_mm;
    // Far outside only the first layer needs to grow.
    may_flood[n] = away_mm[n] <= kThinReach_mm + 2.0 * jaw.grid.spacing_mm ? 1 : 0;
    if (is_far)
      label[n] = kOutside;
    else if (core[n] == 0)
      label[n] = 0;
  }
  flood(size, level, may_flood, label);
  for (std::uint8_t& cell : label) cell = cell == part ? 1 : 0;
  return label;
}

}  // namespace

ToothRegions ToothSurfaces::placed(const Mandible& jaw, const ToothRegions& teeth) {
  if (teeth.box.isEmpty()) return teeth;
  const int room = static_cast<int>(std::ceil((kThinReach_mm + kSlack_mm) / jaw.grid.spacing_mm));
  // The same regions in a box with room around them.
  ToothRegions wide{teeth.box.grown(room, jaw.grid.size), {}, teeth.count};
  const glm::ivec3 size = wide.box.size();
  wide.part.assign(countIn(size), 0);
  forCells(teeth.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
    wide.part[indexIn(size, teeth.box.low - wide.box.low + ijk)] = teeth.part[n];
  });
  struct Asked {
    std::uint8_t part = 0;
    CellBox box;  ///< of the jaw
    std::vector<std::uint8_t> label;
    CellMask cells;
    bool is_known = false;
  };
  std::vector<Asked> asked;
  const std::vector<CellBox> boxes = boxesOfParts(wide);
  for (std::size_t part = 1; part < boxes.size(); ++part) {
    if (boxes[part].isEmpty()) continue;
    const CellBox box = boxes[part].grown(room, size);
    Asked one{static_cast<std::uint8_t>(part), {box.low + wide.box.low, box.end + wide.box.low}, {}, {}, false};
    one.label = croppedTo(box, size, wide.part);
    if (const CellMask* const known = known_.find(one.box, one.label)) one.cells = *known, one.is_known = true;
    asked.push_back(std::move(one));
  }
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t n) {
    if (!asked[n].is_known) asked[n].cells = cellsOf(jaw, asked[n].box, asked[n].part, asked[n].label);
  });
  std::ranges::fill(wide.part, std::uint8_t{0});
  for (Asked& one : asked) {
    forCells(one.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
      std::uint8_t& part = wide.part[indexIn(size, one.box.low - wide.box.low + ijk)];
      if (one.cells[n] != 0 && part == 0) part = one.part;
    });
    if (!one.is_known) known_.keep(one.box, std::move(one.label), std::move(one.cells));
  }
  return wide;
}

}  // namespace assets
