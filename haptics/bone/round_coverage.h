// Coverage and exposure of the voxels of a block under a ball, for whatever cuts or lays with one. Voxel units. Private
// to bone/; servo thread; about 100 ns a block, no allocation, no throw.
#pragma once

#include <algorithm>
#include <cmath>

#include "haptics/bone/block_kernels.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/bone/erosion_step.h"
#include "haptics/bone/lens_curve.h"
#include "haptics/bone/voxel_sphere.h"

namespace haptics {

/// From the centre of a block to that of its farthest voxel.
inline const double kBlockReach = std::sqrt(3.0) * 1.5;

class RoundCoverage {
 public:
  RoundCoverage(const glm::dvec3& centre, double radius, double spacing_mm, const ErosionStep& step)
      : centre_(centre), radius_(radius) {
    const LensCurve curve(std::max(radius, LensCurve::kMinRadius));
    at_.coefficients = curve.coefficients;
    at_.scale = curve.scale;
    at_.offset = curve.offset;
    std::copy(curve.volume.begin(), curve.volume.end(), at_.volume);
    for (int axis = 0; axis < 3; ++axis) at_.axis[axis] = static_cast<float>(step.axis_P.xyz[axis]);
    const double share = step.speed_share > 0.0 ? std::min(step.speed_share, 1.0) : 0.0;
    at_.even = static_cast<float>(1.0 - share);
    at_.per_arm = step.mean_arm_mm > 0.0 ? static_cast<float>(share * spacing_mm / step.mean_arm_mm) : 0.0f;
  }

  double outer() const { return radius_ + kVoxelSphereRadius; }

  /// False: no voxel is covered.
  bool of(glm::ivec3 block, BlockCut& cut) {
    const glm::dvec3 first = glm::dvec3(block * kBlockEdge) - centre_;
    if (glm::length(first + 1.5) - kBlockReach >= outer()) return false;
    for (int axis = 0; axis < 3; ++axis) at_.first[axis] = first[axis];
    coverBlock(at_, cut.coverage.data(), cut.exposure.data());
    if (radius_ < LensCurve::kMinRadius) coverByClosedForm(first, cut);
    return true;
  }

 private:
  /// The curve is not valid for a bur of a few voxels.
  void coverByClosedForm(const glm::dvec3& first, BlockCut& cut) const {
    for (int n = 0; n < kBlockVoxels; ++n) {
      const auto at = static_cast<std::size_t>(n);
      const double d = glm::length(first + glm::dvec3(n & 3, n >> 2 & 3, n >> 4));
      const double lens = lensOfSpheres(radius_, kVoxelSphereRadius, d).volume;
      const double uneven = cut.coverage[at] > 0 ? static_cast<double>(cut.exposure[at]) / cut.coverage[at] : 1.0;
      cut.coverage[at] = static_cast<std::uint16_t>(std::clamp(lens, 0.0, 1.0) * 65535.0 + 0.5);
      cut.exposure[at] = static_cast<std::uint32_t>(cut.coverage[at] * uneven);
    }
  }

  glm::dvec3 centre_;
  double radius_;
  BlockUnderBur at_{};
};

}  // namespace haptics
