// Checks of a closed triangle mesh by slow and obvious methods. Test code only.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "assets/mesh.h"

namespace assets::test {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// "" if every edge has exactly two triangles in opposite directions, else a message.
inline std::string opennessOf(const std::vector<std::uint32_t>& triangles) {
  std::map<Edge, int> walked;
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    for (std::size_t c = 0; c < 3; ++c) ++walked[{triangles[t + c], triangles[t + (c + 1) % 3]}];
  for (const auto& [edge, times] : walked) {
    const auto back = walked.find({edge.second, edge.first});
    if (edge.first == edge.second) return "an edge from a vertex to itself";
    if (times != 1) return "an edge walked " + std::to_string(times) + " times in one direction";
    if (back == walked.end()) return "an edge with one triangle";
  }
  return "";
}

/// Used vertices - edges + triangles.
inline int eulerCharacteristic(const std::vector<std::uint32_t>& triangles) {
  const std::set<std::uint32_t> vertices(triangles.begin(), triangles.end());
  const auto faces = static_cast<int>(triangles.size() / 3);
  return static_cast<int>(vertices.size()) - 3 * faces / 2 + faces;
}

inline double volume(const MeshPart& mesh) {
  double six_fold = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 a = mesh.position_mm[mesh.triangles[t]], b = mesh.position_mm[mesh.triangles[t + 1]],
                     c = mesh.position_mm[mesh.triangles[t + 2]];
    six_fold += glm::dot(a, glm::cross(b, c));
  }
  return six_fold / 6.0;
}

inline double area(const MeshPart& mesh) {
  double two_fold = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 a = mesh.position_mm[mesh.triangles[t]], b = mesh.position_mm[mesh.triangles[t + 1]],
                     c = mesh.position_mm[mesh.triangles[t + 2]];
    two_fold += glm::length(glm::cross(b - a, c - a));
  }
  return two_fold / 2.0;
}

/// Winding number of the mesh about a point: the solid angle of its triangles (Van Oosterom & Strackee 1983) over 4 pi.
inline double windingNumber(const MeshPart& mesh, const glm::dvec3& point) {
  double angle = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 a = glm::dvec3(mesh.position_mm[mesh.triangles[t]]) - point;
    const glm::dvec3 b = glm::dvec3(mesh.position_mm[mesh.triangles[t + 1]]) - point;
    const glm::dvec3 c = glm::dvec3(mesh.position_mm[mesh.triangles[t + 2]]) - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return angle / (4.0 * 3.14159265358979323846);
}

}  // namespace assets::test
