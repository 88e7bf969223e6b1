// The crown of a tooth as measures of a preparation read it: a box of the fine field around all of the tooth above its
// cervical line, voxel by voxel, with its tissues. The field of a session is copied into such a box each time it is
// measured: some 20 ms a molar at 0.05 mm, 8 MB. Frame P, mm. Immutable; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/procedure/root_canal/tooth_blocks.h"
#include "assets/tissue.h"
#include "assets/tooth_canals.h"

namespace app {

/// A byte a voxel, i fastest; 0 outside.
class BoxBytes {
 public:
  explicit BoxBytes(const assets::VolumeGrid& grid) : grid_(grid), bytes_(grid.voxelCount()) {}
  /// Of a field on a grid of which the box is a part.
  BoxBytes(const FineSolid& field, const assets::VolumeGrid& box);

  const assets::VolumeGrid& grid() const { return grid_; }
  std::span<const std::uint8_t> bytes() const { return bytes_; }
  std::span<std::uint8_t> bytes() { return bytes_; }
  std::uint8_t voxel(glm::ivec3 ijk) const { return grid_.contains(ijk) ? bytes_[grid_.index(ijk)] : std::uint8_t{0}; }
  std::uint8_t nearest(const glm::dvec3& p_P_mm) const {
    return voxel(glm::ivec3(glm::floor(grid_.indexFromPoint(p_P_mm) + 0.5)));
  }
  /// 0..1, linear between the centres of voxels.
  double at(const glm::dvec3& p_P_mm) const { return atIndex(grid_.indexFromPoint(p_P_mm)); }
  /// Of a continuous index.
  double atIndex(const glm::dvec3& index) const;
  /// How much of a stretch is solid, mm: a voxel's byte is the share of it that is solid, so that the sum says where a
  /// wall lies within 2 µm at 0.05 mm, whereas the place where the value passes one half depends on how the wall meets
  /// the voxels.
  double solidBetween_mm(const glm::dvec3& from_P_mm, const glm::dvec3& way_P, double length_mm) const;

 private:
  /// All eight voxels around lie within the grid.
  double inside(const glm::dvec3& index) const {
    const glm::ivec3 ijk(index);
    const glm::dvec3 f = index - glm::dvec3(ijk);
    const auto row = static_cast<std::size_t>(grid_.size.x), layer = row * static_cast<std::size_t>(grid_.size.y);
    const std::uint8_t* const byte = &bytes_[grid_.index(ijk)];
    const auto along = [&](std::size_t from) { return byte[from] + f.x * (byte[from + 1] - byte[from]); };
    const double below = along(0) + f.y * (along(row) - along(0));
    const double above = along(layer) + f.y * (along(layer + row) - along(layer));
    return (below + f.z * (above - below)) / 255.0;
  }
  bool isInside(const glm::dvec3& index) const {
    const glm::dvec3 last(grid_.size - 1);
    return index.x >= 0.0 && index.y >= 0.0 && index.z >= 0.0 && index.x < last.x && index.y < last.y &&
           index.z < last.z;
  }

  assets::VolumeGrid grid_;
  std::vector<std::uint8_t> bytes_;
};

/// Half of the stretch along which a wall is looked for.
inline double wallReach_mm(const assets::VolumeGrid& grid) { return 1.75 * grid.spacing_mm; }

struct Crown {
  assets::ToothFrame frame;
  BoxBytes solid, label;
  double top_mm = 0.0;    ///< of its highest cusp, in its frame
  double reach_mm = 0.0;  ///< from its axis, the farthest

  /// `below_mm`: how far under the cervical line the box goes.
  Crown(const ToothBlocks& tooth, const assets::ToothFrame& frame, double below_mm = 1.0);

  /// Of the tooth itself, not of a neighbour nor of bone.
  bool isTooth(glm::ivec3 ijk) const { return assets::isToothPart(label.voxel(ijk)); }
  bool isTooth(const glm::dvec3& p_P_mm) const { return assets::isToothPart(label.nearest(p_P_mm)); }
};

/// Without what no longer hangs on the tooth's neck: slivers of enamel that stand at a neighbour. Some 15 ms.
BoxBytes attached(const Crown& crown, const BoxBytes& made);

}  // namespace app
