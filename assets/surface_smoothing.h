// Takes the lumps off a triangle surface without shrinking it: steps towards the mean of the neighbours, each followed
// by a larger one back (Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995). Waves longer
// than about 14 edges stay, shorter ones fade. Frame and unit of the input; any thread; some milliseconds a step for
// 10^5 vertices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace assets {

inline void takeOffLumps(std::vector<glm::vec3>& position_mm, const std::vector<std::uint32_t>& triangles, int steps) {
  constexpr float kThere = 0.6307f, kBack = -0.6732f;  // pass band 0.1
  // Each edge once in either direction; in a closed surface both triangles give it.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(2 * triangles.size());
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = triangles[t + corner], b = triangles[t + (corner + 1) % 3];
      edges.emplace_back(a, b);
      edges.emplace_back(b, a);
    }
  std::ranges::sort(edges);
  edges.erase(std::ranges::unique(edges).begin(), edges.end());

  std::vector<glm::vec3> moved(position_mm.size());
  for (int step = 0; step < 2 * steps; ++step) {
    const float share = step % 2 == 0 ? kThere : kBack;
    for (std::size_t e = 0; e < edges.size();) {
      const std::uint32_t vertex = edges[e].first;
      glm::vec3 sum(0.0f);
      float count = 0.0f;
      for (; e < edges.size() && edges[e].first == vertex; ++e, ++count) sum += position_mm[edges[e].second];
      moved[vertex] = position_mm[vertex] + share * (sum / count - position_mm[vertex]);
    }
    for (std::size_t e = 0; e < edges.size(); ++e) position_mm[edges[e].first] = moved[edges[e].first];
  }
}

}  // namespace assets
