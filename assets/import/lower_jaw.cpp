#include "assets/import/lower_jaw.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/tooth.h"

namespace assets {
namespace {

constexpr double kCell_mm = 2.0;
constexpr double kFace_mm = 25.0, kLateral_mm = 18.0, kHollowFrom_mm = 22.0, kHollowTo_mm = 40.0, kHollowHalf_mm = 6.0;
constexpr double kArchHeight_mm = 26.0, kChin_mm = 16.0, kFront_mm = 20.0, kWall_mm = 60.0;
constexpr int kMinFront = 3;  ///< cells of bone in the front row of a slice

/// Solid cells of 2 mm: i to the left, j to the back, k up.
struct Coarse {
  glm::ivec3 size{0};
  double cell_mm = kCell_mm;
  std::vector<bool> solid;

  bool at(int i, int j, int k) const {
    if (i < 0 || j < 0 || k < 0 || i >= size.x || j >= size.y || k >= size.z) return false;
    return solid[indexIn(size, {i, j, k})];
  }
};

Coarse coarseOf(const CtVolume& ct) {
  const int step = std::max(1, static_cast<int>(std::lround(kCell_mm / ct.grid.spacing_mm)));
  Coarse coarse;
  coarse.cell_mm = step * ct.grid.spacing_mm;
  coarse.size = (ct.grid.size + step - 1) / step;
  std::vector<std::uint32_t> count(countIn(coarse.size));
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.solid[v] >= kHalfSolid) ++count[indexIn(coarse.size, ijk / step)];
  });
  const double half = 0.3 * step * step * step;
  for (const std::uint32_t solid : count) coarse.solid.push_back(solid >= half);
  return coarse;
}

/// Foremost row of a slice with bone, and the middle of its bone.
struct Front {
  int row = std::numeric_limits<int>::max();
  double middle = 0.0;
};

Front frontOf(const Coarse& coarse, int k) {
  for (int j = 0; j < coarse.size.y; ++j) {
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < coarse.size.x; ++i)
      if (coarse.at(i, j, k) && coarse.at(i, j + 1, k)) sum += i, ++count;
    if (count >= kMinFront) return {j, sum / count};
  }
  return {};
}

/// Bone on both sides behind the front, none in the middle behind the chin.
bool isArch(const Coarse& coarse, int k, const Front& front) {
  const auto cells = [&](double mm) { return static_cast<int>(std::lround(mm / coarse.cell_mm)); };
  const int middle = static_cast<int>(std::lround(front.middle)), aside = cells(kLateral_mm);
  bool right = false, left = false;
  for (int j = front.row; j <= front.row + cells(kWall_mm); ++j)
    for (int i = 0; i < coarse.size.x; ++i) {
      if (!coarse.at(i, j, k)) continue;
      right |= i <= middle - aside;
      left |= i >= middle + aside;
      const bool in_hollow = std::abs(i - middle) <= cells(kHollowHalf_mm) && j >= front.row + cells(kHollowFrom_mm) &&
                             j <= front.row + cells(kHollowTo_mm);
      if (in_hollow) return false;
    }
  return right && left;
}

std::optional<glm::dvec3> archOf(const CtVolume& ct) {
  const Coarse coarse = coarseOf(ct);
  std::vector<Front> fronts;
  int foremost = std::numeric_limits<int>::max();
  for (int k = 0; k < coarse.size.z; ++k) {
    fronts.push_back(frontOf(coarse, k));
    foremost = std::min(foremost, fronts.back().row);
  }
  if (foremost == std::numeric_limits<int>::max()) return std::nullopt;

  // The lowest slices of the face are the chin; the arch begins there or slightly above.
  const auto cells = [&](double mm) { return static_cast<int>(std::ceil(mm / coarse.cell_mm)); };
  const int height = cells(kArchHeight_mm), face = foremost + cells(kFace_mm);
  const auto is_face = [&](int k) { return fronts[static_cast<std::size_t>(k)].row <= face; };
  int lowest = 0;
  while (!is_face(lowest)) ++lowest;
  int first = lowest;
  for (int k = lowest; k < coarse.size.z && k - first < height; ++k)
    if (!is_face(k) || !isArch(coarse, k, fronts[static_cast<std::size_t>(k)])) first = k + 1;
  if (first > lowest + cells(kChin_mm)) return std::nullopt;
  if (first + height > coarse.size.z) return std::nullopt;

  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (int k = first; k < first + height; ++k) {
    const int row = fronts[static_cast<std::size_t>(k)].row;
    for (int j = row; j < row + static_cast<int>(kFront_mm / coarse.cell_mm); ++j)
      for (int i = 0; i < coarse.size.x; ++i)
        if (coarse.at(i, j, k)) sum += glm::dvec3(i, j, k), count += 1.0;
  }
  return ct.grid.origin_P_mm + coarse.cell_mm * (sum / count + 0.5) - 0.5 * ct.grid.spacing_mm;
}

std::optional<glm::dvec3> centroidOfLowerTeeth(const CtVolume& ct) {
  if (ct.tooth.empty()) return std::nullopt;
  const auto [count, sum] = voxelSum(ct.grid, [&](std::size_t v) { return ct.tooth[v] != 0 && !isUpper(ct.tooth[v]); });
  if (count == 0.0) return std::nullopt;
  return ct.grid.origin_P_mm + ct.grid.spacing_mm * (sum / count);
}

}  // namespace

std::optional<glm::dvec3> lowerJawCentre_P_mm(const CtVolume& ct,
                                              const std::vector<glm::dvec3>& mandibular_canal_P_mm) {
  if (const auto teeth = centroidOfLowerTeeth(ct)) return teeth;
  if (!mandibular_canal_P_mm.empty()) return mandibular_canal_P_mm[mandibular_canal_P_mm.size() / 2];
  return archOf(ct);
}

}  // namespace assets
