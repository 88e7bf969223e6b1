// Distance of a point from a polyline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

namespace tests {

inline double distanceToLine(const std::vector<glm::dvec3>& line, const glm::dvec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s + 1 < line.size(); ++s) {
    const glm::dvec3 segment = line[s + 1] - line[s];
    const double t = glm::clamp(glm::dot(p - line[s], segment) / glm::dot(segment, segment), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, line[s] + t * segment));
  }
  return nearest;
}

}  // namespace tests
