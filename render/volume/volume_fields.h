// The live bone and the fields derived from it, on the CPU: solid fraction, a smoothed copy for normals, a coarse mean
// for ambient occlusion, appearance and label of every voxel. The CPU back-end reads them, VolumeTexture uploads what
// changed. The owner of the carved bone sends bricks. Frame P by the grid. Render thread. Memory: 8 bytes a voxel.
// Cost of a carved frame: about 2 ns a voxel of the changed box and its border (40 us for a bur of 2 mm at 0.2 mm).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "assets/solid_voxels.h"
#include "assets/volume_grid.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "render/volume/bordered_field.h"
#include "render/volume/occupancy.h"
#include "render/volume/smooth_field.h"

namespace render {

class VolumeFields;

/// A moved piece of tooth: it shades the volume, itself, and meshes.
struct PlacedFields {
  const VolumeFields* fields = nullptr;
  calibration::Pose<calibration::Patient, calibration::Piece> X_PQ;
};

/// The boxes that prepare() wrote, for copies of the fields.
struct FieldChanges {
  std::vector<VoxelBox> solid, smooth;  ///< voxels
  std::vector<VoxelBox> ambient;        ///< cells
  std::vector<VoxelBox> tissue;         ///< voxels: label and appearance
};

class VolumeFields {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Throws GpuError if they do not
  /// fit.
  VolumeFields(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
               std::span<const std::uint8_t> label);

  /// New content of one brick, i fastest; values outside the volume are ignored.
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values);
  /// The tissue of what lies in a brick beside the scanned one, as a filling; 0: the scanned one.
  void updateTissue(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> values);
  /// The pieces around from the next prepare() on, borrowed until the next call. `changed`: one of them was cut.
  /// Cost: 20 ns a cell of their boxes, now and before, where a pose or piece is another.
  void place(std::span<const PlacedFields> pieces, bool changed);
  /// Before drawing: updates all fields after updateBrick(). The result is valid until the next call.
  const FieldChanges& prepare();

  const assets::VolumeGrid& grid() const { return grid_; }
  /// 255 for solid, 0 in the border.
  const BorderedField<std::uint8_t>& solid() const { return solid_; }
  /// The same, for surfaces.
  assets::SolidVoxels voxels() const;
  /// 65535 for solid (smooth_field.h), 0 in the border.
  const BorderedField<std::uint16_t>& smooth() const { return smooth_; }
  /// Means of 2x2x2 voxels, one value per cell, four cells along a brick, with the placed pieces; 65535 for solid, 0 in
  /// the border.
  const BorderedField<std::uint16_t>& ambient() const { return ambient_; }
  /// appearance_field.h.
  const BorderedField<std::uint32_t>& appearance() const { return appearance_; }
  /// assets::Tissue of every voxel.
  const BorderedField<std::uint8_t>& label() const { return label_; }

 private:
  void meanCells(const VoxelBox& cells);
  void blendRelabelled();
  VoxelBox brickBox(glm::ivec3 brick) const;
  void addPiece(const PlacedFields& piece, const VoxelBox& cells);
  VoxelBox cellsOf(const PlacedFields& piece) const;

  assets::VolumeGrid grid_;
  BorderedField<std::uint8_t> solid_;
  BorderedField<std::uint16_t> smooth_, ambient_;
  BorderedField<std::uint32_t> appearance_;
  BorderedField<std::uint8_t> label_;
  std::map<std::size_t, std::array<std::uint8_t, Occupancy::kBrickValues>> scanned_;  ///< labels, of bricks with others
  std::set<std::size_t> relabelled_;                                                  ///< bricks, since prepare()
  Smoother smoother_;
  std::vector<VoxelBox> touched_;  ///< voxels changed since prepare()
  std::vector<PlacedFields> pieces_;
  std::vector<VoxelBox> piece_cells_;  ///< of each of them
  std::vector<VoxelBox> shaded_;       ///< cells that pieces have left or reached since prepare()
  FieldChanges changes_;
};

}  // namespace render
