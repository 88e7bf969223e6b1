// Covered fraction of a voxel under a bur of any shape, for forces (contact/shape_overlap) and cutting (bone/carve)
// alike. Voxel units; a voxel is a sphere of its volume (voxel_sphere), eta = 0.62. Any thread; about 30 ns a voxel, 2
// in blocks (bone/head_kernels); no allocation, no throw. Sphere: the exact lens. Other shapes: the plane limit,
//   c = (2 + 3t - t^3)/4 - 3/32 k eta (1 - t^2)^2,     t = -distance / eta, k the sum of the principal curvatures
// (the ball's cap less the deviation of the face from its tangent plane, exact to second order in eta/R), and where two
// faces meet the product of both, so that edges neither grow nor shrink; a revolved head's side is one face, with the
// distance to the nearest segment of its outline. First moment: the cap's, 3/16 eta (1 - t^2)^2
// from the voxel's centre inwards (reference/physics 2.1, 2.3, 5). Heads thinner than 3 eta: voxels are subdivided.
#pragma once

#include <array>

#include "assets/volume_grid.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/head_kernels.h"
#include "haptics/bone/solid_field.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

/// Of one voxel; vectors in T.
struct VoxelShare {
  double fraction = 0.0;   ///< of the voxel, 0..1
  glm::dvec3 moment{0.0};  ///< first moment of the covered part about T's origin, voxels
};

class BurCoverage {
 public:
  /// Empty for an invalid shape or pose. The box extends `margin` voxels beyond the volume.
  BurCoverage(const assets::VolumeGrid& grid, const BurShape& shape,
              const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, int margin = 0) noexcept;

  /// Of a voxel's centre; voxels.
  glm::dvec3 positionInTool(glm::ivec3 ijk) const { return to_T * (glm::dvec3(ijk) - centre); }

  /// Largest signed distance from the faces, outwards positive; its slope is at most 1, so a ball of radius r about p
  /// is outside the bur if this is at least r, and inside if it is at most -r.
  double beyondFaces(const glm::dvec3& p_T) const;

  VoxelShare shareAt(glm::ivec3 ijk) const;

  /// Whether bone/head_kernels are valid: not for heads of a voxel or two.
  bool hasKernel() const { return parts == 1 && !(kind == ShapeKind::sphere && radius < 2.0); }
  HeadShape kernelShape() const;

  VoxelBox box;            ///< of the voxels touched
  glm::dvec3 centre{0.0};  ///< T's origin, continuous index
  glm::dmat3 to_T{1.0};    ///< rotates an index difference into T
  ShapeKind kind = ShapeKind::sphere;
  double radius = 0.0, half = 0.0;        ///< voxels; half the length
  double side_sin = 0.0, side_cos = 1.0;  ///< of the cone's half angle; of the sharpest flat end of a revolved head
  double end_low = 0.0, end_high = 0.0;   ///< of a revolved head's flat ends from the middle; far away: none
  std::array<OutlineSegment<double>, kMostSegments> segment{};
  int segments = 0;
  int parts = 1;             ///< subdivisions of a voxel's edge
  double voxel_reach = 0.0;  ///< from a voxel's middle to the far side of its farthest ball
  double eta = 0.0;          ///< radius of the ball of a part
};

}  // namespace haptics
