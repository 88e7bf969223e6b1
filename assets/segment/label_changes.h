// What an edit changed in labels and tooth numbers, to take it back: the values before it, of the voxels that differ,
// as runs in bricks of 32^3. 6 bytes a run. Plain values; any one thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "assets/segment/voxel_edits.h"

namespace assets {

class LabelChanges {
 public:
  static constexpr int kBrick = 32;

  explicit LabelChanges(const VolumeGrid& grid) : grid_(grid) {}

  /// Before a voxel is changed.
  void keep(const JawSegmentation& jaw, const glm::ivec3& ijk);
  /// The edit is whole: only what differs is kept.
  void pack(const JawSegmentation& jaw);
  /// change() with what was before, once packed.
  void takeBack(const JawSegmentation& jaw, const ChangeVoxel& change) const;

  std::size_t bytes() const;
  bool isEmpty() const { return runs_.empty() && open_.empty(); }

 private:
  struct Run {
    std::uint16_t first = 0, count = 0;  ///< of the brick's cells
    std::uint8_t label = 0, tooth = 0;
  };
  using Cells = std::array<VoxelLabel, std::size_t{kBrick} * kBrick * kBrick>;
  struct OfBrick {
    glm::ivec3 low{0};
    std::vector<Run> runs;
  };

  template <class Visit>
  void forCellsOf(const glm::ivec3& low, const Visit& visit) const;

  VolumeGrid grid_;
  std::map<std::size_t, Cells> open_;
  std::size_t last_ = static_cast<std::size_t>(-1);
  std::vector<OfBrick> runs_;
};

}  // namespace assets
