// Signed distance to what the bur of a planned cut sweeps, sampled on a lattice around it; trilinear between samples.
// Negative inside, exact to about a tenth of the spacing, never more than reach_mm. Frame P, mm. Immutable once built;
// any thread. Building takes some tens of ms, a query about 20 ns.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/glm.hpp>

#include "assets/planned_cut.h"
#include "assets/trilinear.h"
#include "assets/volume_grid.h"
#include "calibration/geometry/segment.h"

namespace assets {

class CutField {
 public:
  /// `bare`: the places over the crown count as well, as for the flap.
  CutField(const PlannedCut& cut, double reach_mm, bool bare = false, double spacing_mm = 0.4) : reach_mm_(reach_mm) {
    const double far_mm = cut.bur_radius_mm + reach_mm;
    glm::dvec3 low(1e9), high(-1e9);
    const auto cover = [&](const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); };
    for (const auto& stroke : cut.strokes_P_mm) std::ranges::for_each(stroke, cover);
    if (bare) std::ranges::for_each(cut.bare_P_mm, cover);
    if (low.x > high.x) return;
    grid_.spacing_mm = spacing_mm;
    grid_.origin_P_mm = low - far_mm;
    grid_.size = glm::ivec3(glm::ceil((high - low + 2.0 * far_mm) / spacing_mm)) + 1;
    mm_.assign(grid_.voxelCount(), static_cast<float>(reach_mm));

    // Each capsule writes the samples around it; the smallest distance is kept.
    const auto write = [&](const glm::dvec3& a, const glm::dvec3& b) {
      const glm::ivec3 first(glm::ceil(grid_.indexFromPoint(glm::min(a, b) - far_mm)));
      const glm::ivec3 last(glm::floor(grid_.indexFromPoint(glm::max(a, b) + far_mm)));
      forVoxels(glm::max(first, glm::ivec3(0)), glm::min(last + 1, grid_.size), [&](glm::ivec3 ijk) {
        float& mm = mm_[grid_.index(ijk)];
        mm = std::min(
            mm, static_cast<float>(calibration::distanceToSegment(grid_.centre_P_mm(ijk), a, b) - cut.bur_radius_mm));
      });
    };
    for (const auto& stroke : cut.strokes_P_mm)
      for (std::size_t n = 0; n + 1 < std::max<std::size_t>(stroke.size(), 2); ++n)
        write(stroke[n], stroke[std::min(n + 1, stroke.size() - 1)]);
    if (bare)
      for (const glm::dvec3& p : cut.bare_P_mm) write(p, p);
  }

  double distance_mm(const glm::dvec3& p_P_mm) const {
    if (mm_.empty()) return reach_mm_;
    const glm::ivec3 base(glm::floor(grid_.indexFromPoint(p_P_mm)));
    if (!grid_.contains(base) || !grid_.contains(base + 1)) return reach_mm_;
    return trilinearAt(grid_, p_P_mm, [&](glm::ivec3 ijk) { return double{mm_[grid_.index(ijk)]}; });
  }
  bool contains(const glm::dvec3& p_P_mm) const { return distance_mm(p_P_mm) < 0.0; }

  /// Corners of the box beyond which every distance is the reach.
  glm::dvec3 low_P_mm() const { return grid_.origin_P_mm; }
  glm::dvec3 high_P_mm() const { return grid_.centre_P_mm(grid_.size - 1); }

 private:
  double reach_mm_;
  VolumeGrid grid_;
  std::vector<float> mm_;
};

}  // namespace assets
