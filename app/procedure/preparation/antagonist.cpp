#include "app/procedure/preparation/antagonist.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

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

struct Support {
  glm::dvec2 place{0.0};
  double height = 0.0;
};

/// Shares of three supports in a load.
glm::dvec3 sharesOf(const std::array<Support, 3>& on, const glm::dvec2& load) {
  const glm::dvec2 a = on[1].place - on[0].place, b = on[2].place - on[0].place, p = load - on[0].place;
  const double area = a.x * b.y - a.y * b.x;
  const double s = (p.x * b.y - p.y * b.x) / area, t = (a.x * p.y - a.y * p.x) / area;
  return {1.0 - s - t, s, t};
}

/// The plane through three supports.
glm::dvec3 planeOf(const std::array<Support, 3>& on) {
  const glm::dmat3 rows(glm::dvec3(on[0].place, 1.0), glm::dvec3(on[1].place, 1.0), glm::dvec3(on[2].place, 1.0));
  return glm::dvec3(on[0].height, on[1].height, on[2].height) * glm::inverse(rows);
}

/// On which a plane loaded at a place comes to rest over all of them: the highest support over the plane replaces one
/// of its three such that the load stays among them (the dual simplex method).
glm::dvec3 restingPlane(const std::vector<Support>& all, const glm::dvec2& load) {
  constexpr double kFar = 1e3, kLow = -1e4, kOver_mm = 1e-6;
  std::array<Support, 3> on{{{{-kFar, -kFar}, kLow}, {{kFar, -kFar}, kLow}, {{0.0, kFar}, kLow}}};
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec3 plane = planeOf(on);
    const Support* highest = nullptr;
    double over = kOver_mm;
    for (const Support& one : all)
      if (const double by = one.height - glm::dot(plane, glm::dvec3(one.place, 1.0)); by > over)
        over = by, highest = &one;
    if (highest == nullptr) break;
    std::optional<std::array<Support, 3>> best;
    double least = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<Support, 3> next = on;
      next[k] = *highest;
      const glm::dvec3 shares = sharesOf(next, load);
      const double worst = std::min({shares.x, shares.y, shares.z});
      if (std::isfinite(worst) && worst > least) least = worst, best = next;
    }
    if (!best) break;
    on = *best;
  }
  return planeOf(on);
}

}  // namespace

Antagonist madeAntagonist(const OcclusalRaster& intact) {
  const std::vector<char> mask = bites(intact);
  std::vector<double> height(mask.size(), 0.0), weight(mask.size(), 0.0);
  glm::dvec2 middle(0.0);
  double count = 0.0;
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto at = static_cast<std::size_t>(y * kCells + x);
      if (mask[at] == 0) continue;
      height[at] = static_cast<double>(intact.at(x, y)), weight[at] = 1.0;
      middle += OcclusalRaster::place_mm(x, y), count += 1.0;
    }
  Antagonist made;
  if (count == 0.0) return made;
  middle /= count;
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
  const glm::dvec3 plane = restingPlane(supports, middle);
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto at = static_cast<std::size_t>(y * kCells + x);
      if (!rests(mask, x, y)) continue;
      const double smooth_mm = height[at] / weight[at];
      made.height_mm.at(x, y) =
          static_cast<float>(smooth_mm + glm::dot(plane, glm::dvec3(OcclusalRaster::place_mm(x, y), 1.0)));
    }
  return made;
}

}  // namespace app
