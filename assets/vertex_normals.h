// Smooth vertex normals: area-weighted sum of the adjacent faces, unit length; (0, 0, 1) for a vertex without area.
// Frame of the input; any thread; one pass. Surfaces with a known gradient (synthetic/face) use that instead.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace assets {

inline std::vector<glm::vec3> vertexNormals(const std::vector<glm::vec3>& position_mm,
                                            const std::vector<std::uint32_t>& triangles) {
  std::vector<glm::dvec3> sum(position_mm.size(), glm::dvec3(0.0));
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const glm::dvec3 a = position_mm[triangles[t]];
    const glm::dvec3 b = position_mm[triangles[t + 1]];
    const glm::dvec3 c = position_mm[triangles[t + 2]];
    const glm::dvec3 area = glm::cross(b - a, c - a);
    for (std::size_t corner = 0; corner < 3; ++corner) sum[triangles[t + corner]] += area;
  }
  std::vector<glm::vec3> normals(sum.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double length = glm::length(sum[i]);
    if (length > 1e-12) normals[i] = glm::vec3(sum[i] / length);
  }
  return normals;
}

}  // namespace assets
