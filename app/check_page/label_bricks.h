// Which bricks of a volume hold a tooth or bone, so that rays pass over the rest: bricks of 8 voxels, and of 32. What a
// voxel belongs to: jaw_views.h. Plain values; any one thread; 0.3 ns a voxel to find on two cores.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace app {

class LabelBricks {
 public:
  static constexpr int kFine = 8, kCoarse = 32;
  static constexpr std::uint8_t kBone = 1, kTooth = 2;

  void find(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what);
  /// A voxel that belongs to something now. What a brick held before it goes on holding.
  void add(const glm::ivec3& ijk, std::uint8_t what);

  /// Of the brick of that edge around a voxel: kBone, kTooth.
  std::uint8_t fineAt(const glm::ivec3& ijk) const { return fine_[assets::indexIn(fine_size_, ijk / kFine)]; }
  std::uint8_t coarseAt(const glm::ivec3& ijk) const { return coarse_[assets::indexIn(coarse_size_, ijk / kCoarse)]; }

 private:
  glm::ivec3 fine_size_{0}, coarse_size_{0};
  std::vector<std::uint8_t> fine_, coarse_;
};

}  // namespace app
