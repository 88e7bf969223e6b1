// Closed surface swept through rings of points around the sweep direction; both ends are closed with a fan about the
// ring's centre. Smooth normals: sharp edges need rings of their own. Frame of the rings, mm. Any thread.
#pragma once

#include <span>
#include <vector>

#include "assets/mesh.h"

namespace assets {

/// All rings of equal size, counter-clockwise seen against the sweep. At least two rings of three points (assert).
using Ring = std::vector<glm::dvec3>;

/// Triangles between consecutive rings of `around` vertices each, in the order of the rings.
void appendSweepTriangles(std::vector<std::uint32_t>& triangles, std::size_t rings, std::size_t around);

/// Without material, name and colours.
MeshPart closedSweep(std::span<const Ring> rings);

/// A circle normal to `along`, which is unit and not x.
Ring circle(const glm::dvec3& centre_mm, const glm::dvec3& along, double radius_mm, std::size_t points);

}  // namespace assets
