// The 256 ways in which a surface can pass through a cube of eight lattice points, as triangles between its edges.
// Derived by the compiler, not listed: on each face of the cube directed lines part solid from air, solid to their
// right seen from outside; the lines join into closed loops, each loop is filled by a fan (after Lorensen & Cline
// 1987). Why the surface is closed: a face's lines follow from its four corners alone, by one rule, and the neighbour
// across it walks them the other way; no fan lays an edge of its own into a face (asserted), so each edge has two
// triangles. The rule where a face's corners alternate: solid corners stay apart, air passes between them. Corner c
// lies at (c & 1, c >> 1 & 1, c >> 2). Edge 4 a + u + 2 v runs along axis a from the corner with coordinates u and v
// along the axes (a + 1) % 3 and (a + 2) % 3. Plain data; any thread. Not the surface of a volume (bone_surface).
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
