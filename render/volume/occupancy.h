// Which bricks a ray can pass without looking: the largest solid value that a trilinear sample inside each brick can
// touch, and from it, per brick, how far the next occupied brick is.
// A brick's maximum covers its 8x8x8 voxels and one voxel around them, the footprint of every sample inside.
// A brick is occupied when its maximum reaches `visible_from`: kSolidFrom for the surface solid = 0.5 (128 of 255).
// Plain CPU data, one thread; reads the field it is given and keeps no reference to it. Update: at most 27 bricks of
// 1000 voxels (about 10 us); rebuilding the distances: 13 look-ups per brick twice (about 1 ms for 256^3 voxels).
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
  static constexpr std::uint8_t kSolidFrom = 128;
  static constexpr std::uint8_t kFarthest = 31;

  explicit Occupancy(const BorderedField<std::uint8_t>& solid, std::uint8_t visible_from = kSolidFrom);

  /// Voxels of this box changed.
  void touch(const VoxelBox& box);
  /// From which value on a voxel is seen; the next refresh() rebuilds when it differs.
  void setVisibleFrom(std::uint8_t value);

  /// Brings the emptiness up to date where skipping would otherwise miss something; where bricks only became empty it
  /// may stay too small, which costs time but shows the same picture. True if emptiness() changed.
  bool refresh(const BorderedField<std::uint8_t>& solid);
  /// Makes the emptiness exact; true if it was not.
  bool rebuildIfStale(const BorderedField<std::uint8_t>& solid);

  glm::ivec3 bricks() const { return bricks_; }
  /// Per brick, i fastest: the largest value a sample inside can touch.
  std::span<const std::uint8_t> largest() const { return largest_; }
  /// Per brick: Chebyshev distance in bricks to the next occupied one, at most kFarthest; 0: occupied itself.
  std::span<const std::uint8_t> emptiness() const { return emptiness_; }

 private:
  std::size_t brickIndex(glm::ivec3 brick) const;
  std::uint8_t largestAround(const BorderedField<std::uint8_t>& solid, glm::ivec3 brick) const;
  void rebuild();

  glm::ivec3 bricks_;
  std::uint8_t visible_from_;
  std::vector<std::uint8_t> largest_, emptiness_;
  std::vector<glm::ivec3> pending_;  ///< bricks whose maximum may have changed
  std::vector<std::uint8_t> is_pending_;
  bool stale_ = false, rebuild_now_ = false;
};

}  // namespace render
