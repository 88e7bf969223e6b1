// A signed distance turned into a triangle mesh by OpenVDB: a narrow-band level set, meshed adaptively, its vertices
// moved onto the exact surface and given the gradient as normal.
// mm, frame of the distance; negative inside; triangles counter-clockwise seen from outside. Any thread; parallel
// inside, the result does not depend on the number of threads. Cost: about 2 evaluations a voxel near the surface. The
// distance may be a bound, but must not grow faster than 1.3 mm a mm. Not a mesher of label volumes (gingiva_surface).
#pragma once

#include <functional>

#include "assets/mesh.h"

namespace assets {

using Distance = std::function<double(const glm::dvec3&)>;

struct MeshingBox {
  glm::dvec3 low_mm{0.0};
  glm::dvec3 high_mm{0.0};
};

/// Everything inside the box; a body that leaves it stays open there. `adaptivity` 0..1: how flat a region must be to
/// be drawn with larger triangles.
MeshPart meshOf(const Distance& distance_mm, const MeshingBox& box, double voxel_mm, double adaptivity);

}  // namespace assets
