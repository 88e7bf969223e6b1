#include "assets/mesh/closed_sweep.h"

#include <cassert>
#include <cmath>

#include "assets/vertex_normals.h"
#include "calibration/geometry/units.h"

namespace assets {

void appendSweepTriangles(std::vector<std::uint32_t>& triangles, std::size_t rings, std::size_t around) {
  const auto at = [&](std::size_t ring, std::size_t a) {
    return static_cast<std::uint32_t>(ring * around + a % around);
  };
  for (std::size_t ring = 0; ring + 1 < rings; ++ring)
    for (std::size_t a = 0; a < around; ++a) {
      triangles.insert(triangles.end(), {at(ring, a), at(ring, a + 1), at(ring + 1, a + 1)});
      triangles.insert(triangles.end(), {at(ring, a), at(ring + 1, a + 1), at(ring + 1, a)});
    }
}

MeshPart closedSweep(std::span<const Ring> rings) {
  assert(rings.size() >= 2 && rings.front().size() >= 3);
  const std::size_t around = rings.front().size();
  MeshPart part;
  for (const Ring& ring : rings) {
    assert(ring.size() == around);
    part.position_mm.insert(part.position_mm.end(), ring.begin(), ring.end());
  }
  const auto at = [&](std::size_t ring, std::size_t a) {
    return static_cast<std::uint32_t>(ring * around + a % around);
  };
  appendSweepTriangles(part.triangles, rings.size(), around);

  const auto close = [&](std::size_t ring, bool is_last) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : rings[ring]) middle += p / static_cast<double>(around);
    const auto centre = static_cast<std::uint32_t>(part.position_mm.size());
    part.position_mm.emplace_back(middle);
    for (std::size_t a = 0; a < around; ++a)
      part.triangles.insert(part.triangles.end(),
                            {centre, at(ring, is_last ? a : a + 1), at(ring, is_last ? a + 1 : a)});
  };
  close(0, false);
  close(rings.size() - 1, true);
  part.normal = vertexNormals(part.position_mm, part.triangles);
  return part;
}

Ring circle(const glm::dvec3& centre_mm, const glm::dvec3& along, double radius_mm, std::size_t points) {
  const glm::dvec3 up = glm::normalize(glm::cross(along, glm::dvec3(1, 0, 0))), across = glm::cross(up, along);
  Ring ring;
  for (std::size_t n = 0; n < points; ++n) {
    const double turn = 2.0 * calibration::kPi * static_cast<double>(n) / static_cast<double>(points);
    ring.push_back(centre_mm + radius_mm * (std::cos(turn) * across + std::sin(turn) * up));
  }
  return ring;
}

}  // namespace assets
