// Which way is out of the bone and teeth as they were before the first cut: the direction in which measures tell
// sweeping from plunging. Frame P. Immutable; any thread. A voxel costs 60 ns, once, and 4 bytes; a fine field is taken
// in steps of 0.2 mm.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <glm/glm.hpp>

#include "assets/volume_grid.h"

namespace haptics {
class DistanceField;
}

namespace app {

class OriginalSurface {
 public:
  static constexpr double kBand_mm = 8.0;  ///< farther from the surface there is no normal

  /// `solid` in the order of the grid (assert).
  OriginalSurface(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid);
  ~OriginalSurface();

  /// Unit length; 0 where no surface is near.
  glm::dvec3 normalAt(const glm::dvec3& p_P_mm) const;
  /// Signed, negative inside; to a third of a voxel or of 0.2 mm, at most kBand_mm.
  double distance_mm(const glm::dvec3& p_P_mm) const;

 private:
  assets::VolumeGrid grid_;
  std::unique_ptr<haptics::DistanceField> field_;
};

}  // namespace app
