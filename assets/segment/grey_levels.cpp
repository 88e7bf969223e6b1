#include "assets/segment/grey_levels.h"

#include <algorithm>
#include <cmath>

#include "assets/segment/cell_filters.h"

namespace assets {
namespace {

constexpr int kStep = 2;
constexpr double kShellFrom_mm = 0.7, kShellTo_mm = 1.7, kBelowBite_mm = 22.0;
constexpr float kLeastBone_hu = 500.0F;
constexpr std::size_t kLeastShell = 500, kBins = 120;
constexpr double kAboveCortical_hu = 120.0, kHighest_hu = 3200.0, kUsualStep_hu = 400.0, kMostDentine_hu = 2150.0;

/// The first peak of a smoothed histogram.
double dentineLevel(const std::vector<float>& greys, double cortical_hu) {
  const double low = cortical_hu + kAboveCortical_hu, width = (kHighest_hu - low) / kBins;
  std::vector<float> count(kBins, 0.0F);
  for (const float hu : greys)
    if (hu > low && hu < kHighest_hu) count[static_cast<std::size_t>((hu - low) / width)] += 1.0F;
  smoothCells({static_cast<int>(kBins), 1, 1}, 3.0, count);
  const float most = *std::ranges::max_element(count);
  for (std::size_t bin = 1; bin + 1 < kBins; ++bin)
    if (count[bin] >= count[bin - 1] && count[bin] > count[bin + 1] && count[bin] > 0.15F * most)
      return low + (static_cast<double>(bin) + 0.5) * width;
  return cortical_hu + kUsualStep_hu;
}

}  // namespace

GreyLevels greyLevelsOf(const Mandible& jaw, const BiteSheet& sheet) {
  // Every second voxel along each axis is enough.
  const glm::ivec3 size = (jaw.grid.size + kStep - 1) / kStep;
  const double spacing_mm = kStep * jaw.grid.spacing_mm;
  CellMask solid(countIn(size));
  std::vector<float> greys(solid.size()), hard;
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    const std::size_t v = jaw.grid.index(kStep * ijk);
    solid[n] = jaw.solid[v];
    greys[n] = jaw.smooth_hu[v];
    if (jaw.hard[v] != 0) hard.push_back(greys[n]);
  });
  const std::vector<float> depth_mm = depthInside_mm(size, spacing_mm, solid);
  const double below_P_mm = sheet.height_P_mm - kBelowBite_mm;
  std::vector<float> shell;
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    const bool is_shell = depth_mm[n] > kShellFrom_mm && depth_mm[n] < kShellTo_mm && greys[n] > kLeastBone_hu;
    if (is_shell && jaw.grid.origin_P_mm.z + spacing_mm * ijk.z < below_P_mm) shell.push_back(greys[n]);
  });
  GreyLevels levels;
  if (shell.size() > kLeastShell) {
    std::ranges::nth_element(shell, shell.begin() + static_cast<std::ptrdiff_t>(shell.size() / 2));
    levels.cortical_hu = static_cast<double>(shell[shell.size() / 2]);
  }
  levels.dentine_hu = dentineLevel(hard, levels.cortical_hu);
  if (levels.dentine_hu > kMostDentine_hu) levels.dentine_hu = levels.cortical_hu + kUsualStep_hu;
  return levels;
}

}  // namespace assets
