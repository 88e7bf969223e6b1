// Soft tissue as a field: the distance to the nearest drawn surface of gingiva, lip, cheek or tongue, and which tissue
// that is, on a coarse grid (1.5 mm) in frame P. Made from the meshes before a rehearsal (scenery/soft_tissue_distance)
// and stored in its session; the servo reads it. Plain immutable data; any thread. distanceAt: 8 values, about 20 ns.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "assets/soft_tissue.h"
#include "assets/volume_grid.h"

namespace assets {

struct SoftTissueField {
  static constexpr double kPerMm = 256.0;  ///< of the stored distances
  /// Distances are exact up to these, beyond them constant.
  static constexpr double kOutside_mm = 10.0, kInside_mm = 4.0;

  VolumeGrid grid;                     ///< size 0: no soft tissue
  std::vector<std::int16_t> distance;  ///< 1/256 mm, in the order of the grid; negative inside the tissue
  std::vector<std::uint8_t> tissue;    ///< SoftTissue of the nearest surface; `none` beyond the distances above

  bool operator==(const SoftTissueField&) const = default;

  bool isEmpty() const { return distance.empty(); }

  static std::int16_t stored(double distance_mm) {
    return static_cast<std::int16_t>(std::lround(kPerMm * std::clamp(distance_mm, -kInside_mm, kOutside_mm)));
  }

  struct Sample {
    double distance_mm = kOutside_mm;
    glm::dvec3 gradient_P{0.0};  ///< of the interpolated field, about a unit vector; 0 beyond the stored range
  };
  /// Trilinear; `outside` beyond the grid and for a point that is not finite.
  Sample at(const glm::dvec3& p_P_mm) const noexcept {
    const glm::dvec3 index = grid.indexFromPoint(p_P_mm);
    const glm::dvec3 last = glm::dvec3(grid.size) - 1.0;
    if (!(index.x >= 0.0 && index.y >= 0.0 && index.z >= 0.0 && index.x < last.x && index.y < last.y &&
          index.z < last.z))
      return {};
    const glm::ivec3 low(index);
    const glm::dvec3 f = index - glm::dvec3(low);
    const std::size_t row = static_cast<std::size_t>(grid.size.x), slab = row * static_cast<std::size_t>(grid.size.y);
    const std::int16_t* const d = distance.data() + grid.index(low);
    const auto x = [&](std::size_t at) { return d[at] + f.x * (d[at + 1] - d[at]); };
    const auto slope = [&](std::size_t at) { return static_cast<double>(d[at + 1] - d[at]); };
    const double near_low = x(0), near_high = x(row), far_low = x(slab), far_high = x(slab + row);
    const double near = near_low + f.y * (near_high - near_low), far = far_low + f.y * (far_high - far_low);
    const double along_x = (1.0 - f.z) * ((1.0 - f.y) * slope(0) + f.y * slope(row)) +
                           f.z * ((1.0 - f.y) * slope(slab) + f.y * slope(slab + row));
    const double along_y = (1.0 - f.z) * (near_high - near_low) + f.z * (far_high - far_low);
    return {(near + f.z * (far - near)) / kPerMm,
            glm::dvec3(along_x, along_y, far - near) / (kPerMm * grid.spacing_mm)};
  }

  SoftTissue tissueAt(const glm::dvec3& p_P_mm) const noexcept {
    const glm::dvec3 index = grid.indexFromPoint(p_P_mm) + 0.5;
    const glm::dvec3 size(grid.size);
    if (!(index.x >= 0.0 && index.y >= 0.0 && index.z >= 0.0 && index.x < size.x && index.y < size.y &&
          index.z < size.z))
      return SoftTissue::none;
    const std::uint8_t value = tissue[grid.index(glm::ivec3(index))];
    return value < kSoftTissueCount ? SoftTissue{value} : SoftTissue::none;
  }
};

}  // namespace assets
