#include "assets/segment/bite_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace assets {
namespace {

constexpr double kAcross_mm = 9.0, kPull_mm = 12.0, kPull = 0.12, kStepCost = 0.02, kBlur_cells = 0.7;
constexpr double kSoft_hu = 100.0, kPerHard_hu = 900.0, kMostHard = 2.0;
constexpr int kMostStep = 3;
constexpr double kLeastDense_mm3 = 4.0, kLeastUpper_mm3 = 200.0, kSteepest = 0.6, kSlab_mm = 30.0;
constexpr std::size_t kLeastBins = 12;

using Column = std::vector<double>;  ///< by layer of cells

/// Hard tissue across the arch, and how far from the middle of the dense.
Column costOf(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch, int bin) {
  const auto layers = static_cast<std::size_t>(cells.size.z);
  Column hard(layers, 0.0);
  int samples = 0;
  for (double across = -kAcross_mm; across <= kAcross_mm + 1e-9; across += cells.spacing_mm, ++samples) {
    const glm::dvec3 at = cells.indexFromPoint(glm::dvec3(arch.pointAt(bin, across), 0.0));
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(at + 0.5)), glm::ivec3(0), cells.size - 1);
    for (std::size_t k = 0; k < layers; ++k) {
      const double hu = smooth_hu[cells.index({cell.x, cell.y, static_cast<int>(k)})];
      hard[k] += std::clamp((hu - kSoft_hu) / kPerHard_hu, 0.0, kMostHard);
    }
  }
  // Blurred by three layers, then drawn to the middle.
  const double side = std::exp(-0.5 / (kBlur_cells * kBlur_cells));
  Column cost(layers);
  for (std::size_t k = 0; k < layers; ++k) {
    const double below = hard[k > 0 ? k - 1 : 0], above = hard[std::min(k + 1, layers - 1)];
    const double z = cells.centre_P_mm({0, 0, static_cast<int>(k)}).z;
    const double pull = (z - arch.dense_z_P_mm[static_cast<std::size_t>(bin)]) / kPull_mm;
    cost[k] = (hard[k] + side * (below + above)) / (1.0 + 2.0 * side) / samples + kPull * pull * pull;
  }
  return cost;
}

/// The layers of the cheapest way along the arch.
std::array<std::size_t, kArchBins> cheapestWay(const std::array<Column, kArchBins>& cost) {
  const std::size_t layers = cost[0].size();
  std::array<std::vector<int>, kArchBins> step;
  Column total = cost[0];
  for (std::size_t bin = 1; bin < kArchBins; ++bin) {
    Column next(layers, std::numeric_limits<double>::infinity());
    step[bin].assign(layers, 0);
    for (std::size_t k = 0; k < layers; ++k)
      for (int s = -kMostStep; s <= kMostStep; ++s) {
        const auto from = static_cast<std::ptrdiff_t>(k) - s;
        if (from < 0 || from >= static_cast<std::ptrdiff_t>(layers)) continue;
        const double way = total[static_cast<std::size_t>(from)] + kStepCost * s * s;
        if (way < next[k]) next[k] = way, step[bin][k] = s;
      }
    for (std::size_t k = 0; k < layers; ++k) next[k] += cost[bin][k];
    total = std::move(next);
  }
  std::array<std::size_t, kArchBins> way{};
  way.back() = static_cast<std::size_t>(std::ranges::min_element(total) - total.begin());
  for (std::size_t bin = kArchBins - 1; bin > 0; --bin)
    way[bin - 1] = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(way[bin]) - step[bin][way[bin]]);
  return way;
}

/// The line z over y through the sheet, level from side to side.
void fitPlane(const JawArch& arch, const std::array<bool, kArchBins>& bins, BiteSheet& sheet) {
  double count = 0.0, y_sum = 0.0, z_sum = 0.0, yy = 0.0, yz = 0.0;
  for (int bin = 0; bin < kArchBins; ++bin) {
    if (!bins[static_cast<std::size_t>(bin)]) continue;
    const double y = arch.pointAt(bin, 0.0).y - arch.centre_P_mm.y, z = sheet.z_P_mm[static_cast<std::size_t>(bin)];
    count += 1.0, y_sum += y, z_sum += z, yy += y * y, yz += y * z;
  }
  const double spread = yy - y_sum * y_sum / count;
  const double slope = spread > 1.0 ? (yz - y_sum * z_sum / count) / spread : 0.0;
  sheet.slope = std::clamp(slope, -kSteepest, kSteepest);
  sheet.front_z_P_mm = (z_sum - sheet.slope * y_sum) / count;
}

}  // namespace

glm::dvec2 BiteSheet::aboveAndBehind_mm(const JawArch& arch, const glm::dvec3& p_P_mm) const {
  const double up = p_P_mm.z - front_z_P_mm, back = p_P_mm.y - arch.centre_P_mm.y;
  const double norm = 1.0 / std::sqrt(1.0 + slope * slope);
  return {norm * (up - slope * back), norm * (back + slope * up)};
}

BiteSheet findBiteSheet(const VolumeGrid& cells, const std::vector<float>& smooth_hu, const JawArch& arch) {
  std::array<Column, kArchBins> cost;
  for (int bin = 0; bin < kArchBins; ++bin) cost[static_cast<std::size_t>(bin)] = costOf(cells, smooth_hu, arch, bin);
  const std::array<std::size_t, kArchBins> way = cheapestWay(cost);
  BiteSheet sheet;
  for (std::size_t bin = 0; bin < kArchBins; ++bin)
    sheet.z_P_mm[bin] = cells.centre_P_mm({0, 0, static_cast<int>(way[bin])}).z;

  std::array<double, kArchBins> lower{}, upper{};
  forVoxels(cells, [&](glm::ivec3 ijk, std::size_t n) {
    if (arch.dense[n] == 0) return;
    const glm::dvec3 p = cells.centre_P_mm(ijk);
    const double angle = arch.angleOf(p);
    const auto bin = static_cast<std::size_t>(JawArch::binOf(angle));
    if (std::abs(angle) > kArchEnd_rad || std::abs(p.z - arch.dense_z_P_mm[bin]) > kSlab_mm) return;
    (p.z <= sheet.z_P_mm[bin] ? lower : upper)[bin] += cells.voxelVolume_mm3();
  });
  for (std::size_t bin = 0; bin < kArchBins; ++bin)
    if (arch.has_teeth[bin]) sheet.lower_dense_mm3 += lower[bin], sheet.upper_dense_mm3 += upper[bin];
  std::size_t both = 0;
  if (sheet.upper_dense_mm3 > kLeastUpper_mm3)
    for (std::size_t bin = 0; bin < kArchBins; ++bin) {
      sheet.has_both[bin] = lower[bin] > kLeastDense_mm3 && upper[bin] > kLeastDense_mm3;
      both += sheet.has_both[bin] ? 1 : 0;
    }
  std::vector<double> heights;
  for (std::size_t bin = 0; bin < kArchBins; ++bin)
    if (arch.has_teeth[bin]) heights.push_back(sheet.z_P_mm[bin]);
  std::ranges::nth_element(heights, heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2));
  sheet.height_P_mm = heights[heights.size() / 2];
  fitPlane(arch, both > kLeastBins ? sheet.has_both : arch.has_teeth, sheet);
  return sheet;
}

}  // namespace assets
