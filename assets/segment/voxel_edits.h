// Brush and scissors: voxels of a found jaw are given to a tooth, to the bone or to nothing, after everything that is
// found. Enamel is what is as bright as that; a voxel of another tooth keeps its tissue. What they change can be taken
// back (label_changes.h). Frame P, mm, Hounsfield as scanned. Any one thread but the servo; 20 ns a voxel of the ball.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "assets/segment/jaw_segmentation.h"

namespace assets {

/// What edits need to know of a scan.
struct VoxelScene {
  const VolumeGrid& grid;
  const std::vector<std::int16_t>& hounsfield;
};

struct VoxelLabel {
  std::uint8_t label = 0, tooth = 0;
};
using ChangeVoxel = std::function<void(const glm::ivec3& ijk, std::size_t voxel, VoxelLabel to)>;

/// change() of every voxel that an edit gives another label or number, before it has it. `first`: points of a stroke
/// before it have been painted.
void forVoxelsChangedBy(const VoxelScene& scene, const JawSegmentation& jaw, const VoxelEdit& edit, std::size_t first,
                        const ChangeVoxel& change);

/// Voxels and their places by FDI number.
struct ToothCounts {
  struct Of {
    std::int64_t voxels = 0;
    std::array<std::int64_t, 3> sum{};  ///< of indices
  };
  std::array<Of, 256> of{};

  void add(const glm::ivec3& ijk, std::uint8_t tooth, int times);
};
ToothCounts toothCounts(const VolumeGrid& grid, const std::vector<std::uint8_t>& tooth);
/// Volumes and centres follow; a tooth without voxels goes, one that was painted is a person's.
void takeCounts(const VolumeGrid& grid, const ToothCounts& counts, JawSegmentation& jaw);

/// All of them in order.
void applyVoxelEdits(const VoxelScene& scene, std::span<const VoxelEdit> edits, JawSegmentation& jaw);

/// The grey values of what is like the tissue at a point: within kAlike_hu of the mean about it.
inline constexpr double kAlike_hu = 250.0;
std::array<double, 2> greyLikeAt(const VoxelScene& scene, const glm::dvec3& p_P_mm);

}  // namespace assets
