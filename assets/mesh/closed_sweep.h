// A closed surface through rings of points, each ring around the way it is swept: both ends are closed over the middle
// of their ring. Smooth normals, so edges must be rounded by rings of their own. Frame of the rings, mm. Any thread.
#pragma once

#include <span>
#include <vector>

#include "assets/mesh.h"

namespace assets {

/// As many points in each, counter-clockwise seen from where the sweep goes. At least two rings of three (assert).
using Ring = std::vector<glm::dvec3>;

/// White, without material and name.
MeshPart closedSweep(std::span<const Ring> rings);

/// A circle square to `along`, which is unit and not x.
Ring circle(const glm::dvec3& centre_mm, const glm::dvec3& along, double radius_mm, std::size_t points);

}  // namespace assets
