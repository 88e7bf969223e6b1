#include "assets/segment/tooth_surface.h"

#include <algorithm>
#include <cmath>

#include "assets/scan/exact_distance.h"
#include "assets/segment/cell_filters.h"
#include "assets/segment/flooding.h"

namespace assets {
namespace {

constexpr double kReach_mm = 0.8, kSlack_mm = 1.0, kGradientBlur_cells = 0.5;
constexpr float kPerLevel_hu = 1.0F, kMostLevel = 4000.0F;
constexpr std::uint8_t kOutside = 255;

}  // namespace

void moveToEdges(const Mandible& jaw, ToothRegions& teeth) {
  if (teeth.box.isEmpty()) return;
  // The same regions in a box with room around them.
  const CellBox tight = teeth.box;
  teeth.box = tight.grown(static_cast<int>(std::ceil((kReach_mm + kSlack_mm) / jaw.grid.spacing_mm)), jaw.grid.size);
  const glm::ivec3 size = teeth.box.size();
  std::vector<std::uint8_t> label(countIn(size), 0);
  forVoxels(glm::ivec3(0), tight.size(), [&](glm::ivec3 ijk) {
    label[indexIn(size, tight.low - teeth.box.low + ijk)] = teeth.part[indexIn(tight.size(), ijk)];
  });

  const std::vector<float> away_mm = exactDistance_mm(size, jaw.grid.spacing_mm, label);
  const CellMask core = shrunkByOne(size, label);
  const std::vector<float> gradient =
      gradientOfCells(size, kGradientBlur_cells, croppedTo(teeth.box, jaw.grid.size, jaw.hounsfield));
  std::vector<std::uint16_t> level(label.size());
  CellMask may_flood(label.size());
  for (std::size_t n = 0; n < label.size(); ++n) {
    level[n] = static_cast<std::uint16_t>(std::min(kMostLevel, gradient[n] / kPerLevel_hu));
    const bool is_far = away_mm[n] > kReach_mm;
    // Far outside only the first layer needs to grow.
    may_flood[n] = away_mm[n] <= kReach_mm + 2.0 * jaw.grid.spacing_mm ? 1 : 0;
    if (is_far)
      label[n] = kOutside;
    else if (core[n] == 0)
      label[n] = 0;
  }
  flood(size, level, may_flood, label);
  std::ranges::replace(label, kOutside, std::uint8_t{0});
  teeth.part = std::move(label);
}

}  // namespace assets
