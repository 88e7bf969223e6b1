// The voxels a bur can touch, row by row: which part of a row of voxels lies wholly inside and which is cut by its
// surface. Voxel units and continuous indices of the grid; every index it names is inside the volume.
// Any thread; some 5 ns a row. Any finite or non-finite centre and radius is safe: the ball is then empty.
#pragma once

#include <array>

#include "assets/volume_grid.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {
/// One row: shell [outer_first, inner_first), inside [inner_first, inner_last], shell (inner_last, outer_last].
struct BallRow {
  int outer_first = 0, outer_last = -1;
  int inner_first = 0, inner_last = -1;
  double dy = 0.0, dz = 0.0;  ///< of the row from the centre
};

inline constexpr int kRowsAtOnce = 8;

class BallRows {
 public:
  BallRows(const assets::VolumeGrid& grid, const calibration::Point<calibration::Patient>& centre, double radius_mm);

  bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
  /// Rows j, j+1, … j+7 of plane k, together because that is half the price; rows past last.y mean nothing.
  void rows(int j, int k, std::array<BallRow, kRowsAtOnce>& out) const;

  glm::dvec3 centre{0.0};         ///< continuous index
  double radius = 0.0;            ///< of the bur, voxels
  double outer = 0.0;             ///< voxels whose centre lies beyond touch nothing
  double inner = 0.0;             ///< voxels whose centre lies within are wholly inside; may be negative
  glm::ivec3 first{0}, last{-1};  ///< inclusive box, clipped to the volume
};

}  // namespace haptics
