// Marching cubes cases: for each of 256 corner states the surface in a cube as triangles between its edges (after
// Lorensen & Cline 1987), derived at compile time. On each face directed lines separate solid from air, solid to their
// right seen from outside; they join into closed loops, each filled by a fan. Closed surfaces follow: a face's lines
// depend on its four corners only and the neighbour cube has them reversed; no fan puts an edge into a face (checked),
// so each edge has two triangles. On faces with alternating corners solid corners stay separate. Corner c lies at (c &
// 1, c >> 1 & 1, c >> 2). Edge 4 a + u + 2 v runs along axis a from the corner with coordinates u and v on axes (a + 1)
// % 3 and (a + 2) % 3. Plain data.
#pragma once

#include <array>
#include <cstdint>

namespace assets {

inline constexpr int kCubeEdges = 12;

struct CubeCase {
  int triangle_count = 0;
  std::array<std::uint8_t, 15> edge{};  ///< three per triangle, counter-clockwise seen from the air
};

/// `solid_corners`: bit c is set where corner c is solid; 0 to 255.
const CubeCase& cubeCase(int solid_corners);

/// The corner from which an edge runs along its axis.
constexpr int firstCorner(int edge) {
  const int axis = edge / 4;
  return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
}

}  // namespace assets
