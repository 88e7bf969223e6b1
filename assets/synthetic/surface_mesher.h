// Triangle mesh of a signed distance by OpenVDB: a narrow-band level set, meshed adaptively, vertices moved onto the
// exact surface, the gradient as normal. mm, frame of the distance; negative inside; triangles counter-clockwise seen
// from outside. Any thread; parallel inside, independent of the number of threads. About 2 evaluations a voxel near the
// surface. The distance may be a bound with a slope of at most 1.3.
#pragma once

#include <functional>

#include "assets/mesh.h"
#include "assets/progress.h"
#include "assets/synthetic/implicit_shape.h"

namespace assets {

using Distance = std::function<double(const glm::dvec3&)>;

/// Inside the box; a body that extends beyond it is open there. `adaptivity` 0..1 merges triangles of flat regions.
MeshPart meshOf(const Distance& distance_mm, const BoundingBox& box, double voxel_mm, double adaptivity,
                const ReportProgress& report = {});

}  // namespace assets
