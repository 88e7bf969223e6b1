// A jaw's risk structures as plain bodies in voxels: a bent canal of 1.5 mm and a molar's crown, and the slow and
// obvious distance to them. Frame P, mm.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "assets/scan/label_distance.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/geometry/segment.h"
#include "haptics/tool/tool.h"
#include "tests/haptics/head_distance.h"

namespace haptics::phantom {

using ToolPose = calibration::Pose<calibration::Patient, calibration::Tool>;

inline constexpr double kCanalRadius_mm = 1.5;

struct VoxelStructure {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> belongs;
  std::vector<glm::dvec3> voxels_P_mm;  ///< centres

  assets::StructureDistance distance() const { return assets::structureDistance(grid, belongs, glm::dvec3(0.0)); }
};

template <class Inside>
VoxelStructure structureOf(double spacing_mm, const Inside& inside) {
  const glm::ivec3 size(glm::round(glm::dvec3(36.0, 24.0, 24.0) / spacing_mm));
  VoxelStructure made{{size, spacing_mm, -0.5 * spacing_mm * glm::dvec3(size - 1)}, {}, {}};
  made.belongs.assign(made.grid.voxelCount(), 0);
  assets::forVoxels(made.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = made.grid.centre_P_mm(ijk);
    if (!inside(p)) return;
    made.belongs[v] = 1;
    made.voxels_P_mm.push_back(p);
  });
  return made;
}

/// Its axis from (-14, 0, 0) over the origin to (14, 4, 2).
inline double canalDistance_mm(const glm::dvec3& p_P_mm) {
  const glm::dvec3 from(-14.0, 0.0, 0.0), to(14.0, 4.0, 2.0);
  return std::min(calibration::distanceToSegment(p_P_mm, from, glm::dvec3(0.0)),
                  calibration::distanceToSegment(p_P_mm, glm::dvec3(0.0), to)) -
         kCanalRadius_mm;
}
inline VoxelStructure canal(double spacing_mm) {
  return structureOf(spacing_mm, [](const glm::dvec3& p) { return canalDistance_mm(p) <= 0.0; });
}
inline VoxelStructure crown(double spacing_mm) {
  return structureOf(spacing_mm, [](const glm::dvec3& p) {
    return glm::length((p - glm::dvec3(3.0, -2.0, 1.0)) / glm::dvec3(5.0, 4.5, 4.0)) <= 1.0;
  });
}

/// From a point outside a head to its surface; 0 inside.
inline double toHead_mm(const BurShape& head, const glm::dvec3& p_T_mm) {
  const double r = head.radius_mm, half = 0.5 * head.length_mm;
  const double across_mm = std::hypot(p_T_mm.x, p_T_mm.y), z = p_T_mm.z;
  switch (head.kind) {
    case ShapeKind::sphere:
      return std::max(0.0, std::hypot(across_mm, z) - r);
    case ShapeKind::capsule:
      return std::max(0.0, std::hypot(across_mm, z - std::clamp(z, -half, half)) - r);
    case ShapeKind::cylinder:
      return std::hypot(std::max(0.0, across_mm - r), std::max(0.0, std::abs(z) - half));
    case ShapeKind::cone: {
      if (z <= half && z >= -half && across_mm <= r * (z + half) / (2.0 * half)) return 0.0;
      const glm::dvec3 p(across_mm, 0.0, z), tip(0.0, 0.0, -half), rim(r, 0.0, half), base(0.0, 0.0, half);
      return std::min(calibration::distanceToSegment(p, tip, rim), calibration::distanceToSegment(p, rim, base));
    }
    case ShapeKind::revolved:
      return std::max(0.0, headDistance_mm(head, {p_T_mm}));
  }
  return 0.0;
}

/// From the head to the nearest voxel's centre, less what a surface lies off it: of heads that hold no voxel's centre.
inline double slowClearance_mm(const VoxelStructure& structure, const BurShape& head, const ToolPose& X_PT) {
  const glm::dquat back = glm::conjugate(X_PT.rotation);
  double least_mm = 1e9;
  for (const glm::dvec3& p : structure.voxels_P_mm)
    least_mm = std::min(least_mm, toHead_mm(head, back * (p - X_PT.translation_mm)));
  return least_mm - assets::StructureDistance::kSurface_voxels * structure.grid.spacing_mm;
}

/// In and around the grid.
inline ToolPose randomPose(std::mt19937& random, double reach_mm) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-reach_mm, reach_mm);
  return {glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))),
          {1.4 * uniform(random), uniform(random), uniform(random)}};
}

}  // namespace haptics::phantom
