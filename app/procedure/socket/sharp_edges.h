// Sharp edges that an operation leaves on the crest of the bone: where it was opened, the surface is convex with a
// radius below kSharp_mm, and no bone around stands more than kCrest_mm higher. The surface is that of a median over a
// ball of kMedian_mm (of solid and empty that is the half of the ball's mean), so that single voxels are no edges.
// Frame P, mm. Worker or command; some 20 ms a socket; allocates. A pure function of the bytes. Definition:
// reference/extraction 9. An edge of 90 degrees has a radius of about 0.3 mm in this surface, one of 135 degrees 0.7.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"

namespace app {

inline constexpr double kSharp_mm = 0.5, kMedian_mm = 0.4, kCrest_mm = 2.0;

struct SharpEdge {
  double length_mm = 0.0;
  double radius_mm = 0.0;               ///< where it is sharpest
  glm::dvec3 middle_P_mm{0.0};          ///< the point of it nearest to its centroid
  std::vector<glm::dvec3> points_P_mm;  ///< along it, kEdgeStep_mm apart at least
};
inline constexpr double kEdgeStep_mm = 0.5;
inline constexpr double kLeastEdge_mm = 1.0;  ///< shorter ones are not listed

/// The bone as it is, in the order of `grid` (assert). Labels: teeth have no sharp edges; empty: all is bone.
struct BoneNow {
  const assets::VolumeGrid& grid;
  std::span<const std::uint8_t> solid, label;
  std::span<const std::uint8_t> opened;  ///< not 0 where solid is gone
};

/// The longest first. `up_P`: unit, out of the jaw.
std::vector<SharpEdge> sharpEdges(const BoneNow& bone, const glm::dvec3& up_P);

}  // namespace app
