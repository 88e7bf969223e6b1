#include "app/case/pointed_tooth.h"

#include <algorithm>
#include <limits>

namespace app {

std::optional<int> pointedTooth(const assets::CtVolume& ct, const glm::dvec3& eye_P_mm, const glm::dvec3& way_P) {
  constexpr double kStep = 0.25;  // voxels
  if (ct.tooth.empty() || !(glm::length(way_P) > 1e-12)) return {};
  const glm::dvec3 from = ct.grid.indexFromPoint(eye_P_mm), way = glm::normalize(way_P);
  // The part of the ray within the grid.
  double near = 0.0, far = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -0.5 - from[axis], high = ct.grid.size[axis] - 0.5 - from[axis];
    if (std::abs(way[axis]) < 1e-12) {
      if (low > 0.0 || high < 0.0) return {};
      continue;
    }
    near = std::max(near, std::min(low / way[axis], high / way[axis]));
    far = std::min(far, std::max(low / way[axis], high / way[axis]));
  }
  for (double t = near; t <= far; t += kStep) {
    const glm::ivec3 ijk(glm::round(from + t * way));
    if (!ct.grid.contains(ijk)) continue;
    const std::size_t v = ct.grid.index(ijk);
    if (ct.solid[v] < assets::kHalfSolid) continue;
    return ct.tooth[v] != 0 ? std::optional<int>(ct.tooth[v]) : std::nullopt;
  }
  return {};
}

std::vector<glm::vec3> markedVoxels_P_mm(const assets::CtVolume& ct, int fdi) {
  std::vector<glm::vec3> marked;
  if (ct.tooth.empty()) return marked;
  assets::forVoxels(glm::ivec3(0), (ct.grid.size + 1) / 2, [&](glm::ivec3 half) {
    const glm::ivec3 ijk = 2 * half;
    const std::size_t v = ct.grid.index(ijk);
    if (ct.tooth[v] == fdi && ct.solid[v] >= assets::kHalfSolid) marked.emplace_back(ct.grid.centre_P_mm(ijk));
  });
  return marked;
}

}  // namespace app
