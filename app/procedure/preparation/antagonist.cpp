#include "app/procedure/preparation/antagonist.h"

#include <algorithm>
#include <vector>

#include "app/procedure/preparation/resting_plane.h"

namespace app {
namespace {

constexpr int kCells = OcclusalRaster::kSide;
constexpr double kCell_mm = OcclusalRaster::kStep_mm;
/// Cusps of the opposing tooth are as broad as fossae are.
constexpr double kSmooth_mm = 0.9;
/// Steeper sides do not bite.
constexpr double kSteepest = 1.73;

/// Of the biting surface: no steep side, nor beside one.
std::vector<char> bites(const OcclusalRaster& intact) {
  std::vector<char> mask(static_cast<std::size_t>(kCells) * kCells, 0);
  constexpr int kApart = 2;
  for (int y = kApart; y < kCells - kApart; ++y)
    for (int x = kApart; x < kCells - kApart; ++x) {
      const double run_mm = 2.0 * kApart * kCell_mm;
      const glm::dvec2 slope(intact.at(x + kApart, y) - intact.at(x - kApart, y),
                             intact.at(x, y + kApart) - intact.at(x, y - kApart));
      // A slope that is none is not less.
      if (intact.has(x, y) && glm::length(slope) / run_mm < kSteepest)
        mask[static_cast<std::size_t>(y * kCells + x)] = 1;
    }
  return mask;
}

/// Where it can rest: within the biting surface, not on its rim, where a single voxel may stand out.
bool rests(const std::vector<char>& mask, int x, int y) {
  constexpr int kRim = 8;  ///< 0.4 mm
  for (int n = 0; n < 9; ++n)
    for (const int reach : {kRim / 2, kRim}) {
      const int i = x + reach * (n % 3 - 1), j = y + reach * (n / 3 - 1);
      if (i < 0 || j < 0 || i >= kCells || j >= kCells || mask[static_cast<std::size_t>(j * kCells + i)] == 0)
        return false;
    }
  return true;
}

/// By a bell along one axis.
std::vector<double> blurred(const std::vector<double>& from, bool along_x) {
  const int reach = static_cast<int>(3.0 * kSmooth_mm / kCell_mm);
  std::vector<double> weight(static_cast<std::size_t>(reach) + 1), to(from.size(), 0.0);
  for (int n = 0; n <= reach; ++n)
    weight[static_cast<std::size_t>(n)] = std::exp(-0.5 * std::pow(n * kCell_mm / kSmooth_mm, 2));
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const int at = along_x ? x : y, low = std::max(-reach, -at), high = std::min(reach, kCells - 1 - at);
      double sum = 0.0;
      for (int n = low; n <= high; ++n)
        sum += weight[static_cast<std::size_t>(std::abs(n))] *
               from[static_cast<std::size_t>(along_x ? y * kCells + x + n : (y + n) * kCells + x)];
      to[static_cast<std::size_t>(y * kCells + x)] = sum;
    }
  return to;
}

/// Of a biting surface.
glm::dvec2 middleOf(const std::vector<char>& mask) {
  glm::dvec2 sum(0.0);
  double count = 0.0;
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x)
      if (mask[static_cast<std::size_t>(y * kCells + x)] != 0) sum += OcclusalRaster::place_mm(x, y), count += 1.0;
  return sum / std::max(1.0, count);
}

}  // namespace

Antagonist madeAntagonist(const OcclusalRaster& intact) {
  const std::vector<char> mask = bites(intact);
  std::vector<double> height(mask.size(), 0.0), weight(mask.size(), 0.0);
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto at = static_cast<std::size_t>(y * kCells + x);
      if (mask[at] == 0) continue;
      height[at] = static_cast<double>(intact.at(x, y)), weight[at] = 1.0;
    }
  Antagonist made;
  made.middle_mm = middleOf(mask);
  height = blurred(blurred(height, true), false);
  weight = blurred(blurred(weight, true), false);
  std::vector<Support> supports;
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto at = static_cast<std::size_t>(y * kCells + x);
      if (rests(mask, x, y))
        supports.push_back(
            {OcclusalRaster::place_mm(x, y), static_cast<double>(intact.at(x, y)) - height[at] / weight[at]});
    }
  if (supports.empty()) return made;
  const auto rests_on = restingPlane(supports, made.middle_mm);
  const double highest_mm = std::ranges::max_element(supports, {}, &Support::height_mm)->height_mm;
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto at = static_cast<std::size_t>(y * kCells + x);
      if (!rests(mask, x, y)) continue;
      const double smooth_mm = height[at] / weight[at];
      const glm::dvec2 place = OcclusalRaster::place_mm(x, y);
      made.height_mm.at(x, y) = static_cast<float>(smooth_mm + (rests_on ? rests_on->at_mm(place) : highest_mm));
    }
  return made;
}

Antagonist antagonistOf(const Crown& crown, const OcclusalRaster& intact, const assets::PreparedTooth& tooth) {
  Antagonist opposes = tooth.opposing ? Antagonist{} : madeAntagonist(intact);
  if (tooth.opposing) {
    opposes.is_made = false;
    opposes.middle_mm = middleOf(bites(intact));
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x)
        opposes.height_mm.at(x, y) = tooth.opposing->height_mm[static_cast<std::size_t>(y * kCells + x)];
  }
  opposes.closing = tooth.bite.closing;
  opposes.hinge_mm = crown.frame.local(tooth.bite.hinge_P_mm);
  opposes.opens = glm::transpose(crown.frame.axes_P)[0];
  // Whichever way lifts what stands over the tooth.
  if (glm::cross(opposes.opens, glm::dvec3(opposes.middle_mm, crown.top_mm) - opposes.hinge_mm).z < 0.0)
    opposes.opens = -opposes.opens;
  return opposes;
}

}  // namespace app
