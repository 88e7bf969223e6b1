// When each voxel that is gone at the end was cut: at the first tick in which a turning bur that took something away
// covered it. From the ticks and the bone before and after alone, so it needs no replay and can be told of sessions of
// any version; what was undone is no removal. Voxels that no bur covered (loose chips, pieces that had moved) have no
// time. Frame P, mm, s. A stream over the ticks; one thread; a tick costs the voxels that the head covers, and nothing
// where it has moved less than a quarter of a voxel.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "assets/volume_grid.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

struct RemovedVoxel {
  glm::ivec3 ijk{0};
  std::size_t index = 0;      ///< in the order of the grid
  double share = 0.0;         ///< of the voxel that is gone
  std::optional<double> t_s;  ///< none: no bur covered it
};

class RemovalClock {
 public:
  /// `before`, `after`: solid fractions in the order of the grid (assert). Borrowed for the call.
  RemovalClock(const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
               std::span<const std::uint8_t> after);

  /// Of what is known already, in the order of the grid.
  RemovalClock(const assets::VolumeGrid& grid, std::vector<RemovedVoxel> removed)
      : grid_(grid), removed_(std::move(removed)) {}

  /// Of a clock made from the bone at the end; `tool` of that tick.
  void add(const haptics::Tick& tick, const haptics::Tool& tool);

  /// In the order of the grid.
  const std::vector<RemovedVoxel>& removed() const { return removed_; }
  const assets::VolumeGrid& grid() const { return grid_; }

 private:
  assets::VolumeGrid grid_;
  std::vector<RemovedVoxel> removed_;
  glm::ivec3 low_{0}, end_{0};       ///< box of them
  std::vector<std::int32_t> place_;  ///< in removed_, by voxel of the box; -1: not removed
  struct Covered {
    glm::dvec3 centre_P_mm;
    glm::dquat rotation;
    haptics::BurShape head;
  };
  std::optional<Covered> last_;
};

}  // namespace app
