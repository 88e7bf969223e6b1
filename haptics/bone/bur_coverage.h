// How much of a voxel a bur of any shape covers, and where: the one function by which a bur is felt
// (contact/shape_overlap) and cuts (bone/carve). Voxel units; a voxel is a sphere of its volume (voxel_sphere), eta =
// 0.62. Any thread; some 30 ns a voxel, 2 in blocks (bone/head_kernels); no allocation, no throw. Sphere: the exact
// lens. Other shapes: the plane limit, t = -distance / eta,
//   c = (2 + 3t - t^3)/4 - 3/32 k eta (1 - t^2)^2,     k the sum of the principal curvatures where the face is round,
// (the ball's cap less what the face bends away from its tangent plane, exact to second order in eta/R), and where two
// faces meet the product of both, so that edges neither grow nor shrink. First moment: the cap's, 3/16 eta (1 - t^2)^2
// from the voxel's centre inwards (physics 2.1, 2.3, 5). Heads thinner than 3 eta are taken in parts of a voxel.
#pragma once

#include "assets/volume_grid.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/head_kernels.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

/// Of one voxel; vectors in T.
struct VoxelShare {
  double fraction = 0.0;   ///< of the voxel, 0..1
  glm::dvec3 moment{0.0};  ///< of what is covered, about T's origin, voxels
};

class BurCoverage {
 public:
  /// Nothing is touched if shape or pose is none. The box goes `margin` voxels beyond the volume.
  BurCoverage(const assets::VolumeGrid& grid, const BurShape& shape,
              const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, int margin = 0) noexcept;

  bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }

  /// Of a voxel's centre, in T, voxels.
  glm::dvec3 positionInTool(glm::ivec3 ijk) const { return to_T * (glm::dvec3(ijk) - centre); }

  /// Distance beyond the face that lies farthest inwards; no steeper than 1, so a ball of radius r about p touches
  /// nothing of the bur if this is at least r, and lies inside it if it is at most -r.
  double beyondFaces(const glm::dvec3& p_T) const;

  VoxelShare shareAt(glm::ivec3 ijk) const;

  /// Whether the kernels for whole blocks (bone/head_kernels) hold: not for heads of a voxel or two.
  bool hasKernel() const { return parts == 1 && !(kind == ShapeKind::sphere && radius < 2.0); }
  HeadShape kernelShape() const;

  glm::ivec3 first{0}, last{-1};  ///< inclusive box of what may be touched, clipped
  glm::dvec3 centre{0.0};         ///< T's origin, continuous index
  glm::dmat3 to_T{1.0};           ///< rotates an index difference into T
  ShapeKind kind = ShapeKind::sphere;
  double radius = 0.0, half = 0.0;        ///< voxels; half the length
  double side_sin = 0.0, side_cos = 1.0;  ///< of the cone's half angle
  int parts = 1;                          ///< a voxel's edge is taken in so many parts
  double voxel_reach = 0.0;               ///< from a voxel's middle to the farthest of its balls
  double eta = 0.0;                       ///< radius of the ball that stands for a part
};

}  // namespace haptics
