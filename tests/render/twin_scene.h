// For back-ends that must draw the same: a ball of triangles, and by how much two pictures differ.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/mesh.h"
#include "render/frame_renderer.h"

namespace render::testing {

// A ball of triangles with smooth normals.
inline assets::MeshPart ballMesh(glm::vec3 centre, float radius, glm::vec4 colour, int rings = 24) {
  assets::MeshPart part;
  part.name = "Ball";
  part.material.base_colour = colour;
  part.material.roughness = 0.5f;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i <= 2 * rings; ++i) {
      const float theta = 3.14159265f * static_cast<float>(j) / static_cast<float>(rings);
      const float phi = 3.14159265f * static_cast<float>(i) / static_cast<float>(rings);
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      part.position_mm.push_back(centre + radius * n);
      part.normal.push_back(n);
    }
  const auto row = static_cast<unsigned>(2 * rings + 1);
  for (unsigned j = 0; j < static_cast<unsigned>(rings); ++j)
    for (unsigned i = 0; i < row - 1; ++i) {
      const unsigned a = j * row + i;
      part.triangles.insert(part.triangles.end(), {a, a + row, a + row + 1, a, a + row + 1, a + 1});
    }
  return part;
}

struct Difference {
  int worst = 0, beyond = 0;  ///< largest difference of 255; pixels that differ by more than two
  double worst_mm = 0.0;
  int other_mm = 0;  ///< pixels whose discrete hit differs
};

// Pixels with different hits, by distance, are counted separately.
inline Difference between(FrameRenderer& a, FrameRenderer& b, const Frame& frame, Eye eye) {
  a.renderEye(frame, eye);
  b.renderEye(frame, eye);
  const Image p = a.readEye(eye), q = b.readEye(eye);
  const DistanceImage s = a.readDistance(eye), t = b.readDistance(eye);
  EXPECT_EQ(p.w, q.w);
  EXPECT_EQ(p.h, q.h);
  Difference d;
  for (std::size_t i = 0; i < s.mm.size(); ++i) {
    int worst = 0;
    for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) worst = std::max(worst, std::abs(p.rgba[c] - q.rgba[c]));
    const double apart_mm = std::abs(static_cast<double>(s.mm[i]) - static_cast<double>(t.mm[i]));
    if (apart_mm > 0.1) {
      ++d.other_mm;
      continue;
    }
    d.worst_mm = std::max(d.worst_mm, apart_mm);
    d.worst = std::max(d.worst, worst);
    d.beyond += worst > 2 ? 1 : 0;
  }
  std::printf("worst %d/255, %d pixels beyond 2; depth %.4f mm, %d pixels hit another thing\n", d.worst, d.beyond,
              d.worst_mm, d.other_mm);
  return d;
}

}  // namespace render::testing
