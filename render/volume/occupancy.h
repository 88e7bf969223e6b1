// Which bricks a ray can pass without looking: those in which no trilinear sample reaches 0.5, where both views begin
// to see something; and from them, per brick, how far the next occupied one is. A sample touches a brick's 8x8x8 voxels
// and one voxel around them; occupied where one of them reaches assets::kHalfSolid. Plain CPU data, one thread; reads
// the field it is given and keeps no reference to it. Update: at most 27 bricks of 1000 voxels (about 10 us); the
// distances: brick_distance.h. The CPU back-end has its own, finer: SolidCells.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "render/volume/bordered_field.h"

namespace render {

class Occupancy {
 public:
  static constexpr int kBrickValues = assets::kBrickVoxels * assets::kBrickVoxels * assets::kBrickVoxels;
  static constexpr std::uint8_t kFarthest = 31;

  explicit Occupancy(const BorderedField<std::uint8_t>& solid);

  /// Voxels of this box changed.
  void touch(const VoxelBox& box);

  /// Brings the emptiness up to date where skipping would otherwise miss something; where bricks only became empty it
  /// may stay too small, which costs time but shows the same picture. True if emptiness() changed.
  bool refresh(const BorderedField<std::uint8_t>& solid);
  /// Makes the emptiness exact; true if it was not.
  bool rebuildIfStale(const BorderedField<std::uint8_t>& solid);

  glm::ivec3 bricks() const { return bricks_; }
  /// Per brick: Chebyshev distance in bricks to the next occupied one, at most kFarthest; 0: occupied itself.
  std::span<const std::uint8_t> emptiness() const { return emptiness_; }

 private:
  std::size_t brickIndex(glm::ivec3 brick) const;
  static bool isOccupied(const BorderedField<std::uint8_t>& solid, glm::ivec3 brick);
  void rebuild();

  glm::ivec3 bricks_;
  std::vector<std::uint8_t> is_occupied_, emptiness_;
  std::vector<glm::ivec3> pending_;  ///< bricks that may have changed
  std::vector<std::uint8_t> is_pending_;
  bool stale_ = false;
};

}  // namespace render
