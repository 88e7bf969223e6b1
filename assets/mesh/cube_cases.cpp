#include "assets/mesh/cube_cases.h"

#include <cstddef>
#include <stdexcept>

namespace assets {
namespace {

/// For every crossed edge the edge its line leads to; -1 elsewhere.
using Lines = std::array<int, kCubeEdges>;

struct Loop {
  std::array<int, kCubeEdges> edge{};
  int length = 0;

  constexpr void add(int next) { edge[static_cast<std::size_t>(length++)] = next; }
  constexpr int at(int n) const { return edge[static_cast<std::size_t>(n % length)]; }
};

constexpr int edgeBetween(int a, int b) {
  const int axis = (a ^ b) >> 1;  // corners differ by 1, 2 or 4
  const auto coordinate = [](int corner, int along) { return corner >> along & 1; };
  return 4 * axis + coordinate(a, (axis + 1) % 3) + 2 * coordinate(a, (axis + 2) % 3);
}

/// Side of the cube along `across` on which an edge lies; -1 for an edge along that axis.
constexpr int sideOf(int edge, int across) {
  const int axis = edge / 4;
  if (axis == across) return -1;
  return (across == (axis + 1) % 3 ? edge : edge >> 1) & 1;
}

constexpr bool inOneFace(int e, int f) {
  for (int across = 0; across < 3; ++across)
    if (sideOf(e, across) >= 0 && sideOf(e, across) == sideOf(f, across)) return true;
  return false;
}

/// Adds the lines of one face.
constexpr void addFace(Lines& lines, int solid_corners, int axis, int side) {
  // Corners, counter-clockwise from outside.
  const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, low = side << axis;
  const std::array<int, 4> ring = side == 1 ? std::array{low, low | u, low | u | v, low | v}  //
                                            : std::array{low, low | v, low | u | v, low | u};
  const auto corner = [&](int n) { return ring[static_cast<std::size_t>(n & 3)]; };
  const auto is_solid = [&](int n) { return (solid_corners >> corner(n) & 1) != 0; };

  // One line per run of solid corners, from its begin to its end.
  for (int n = 0; n < 4; ++n) {
    if (is_solid(n) || !is_solid(n + 1)) continue;
    int last = n + 1;
    while (is_solid(last + 1)) ++last;
    lines[static_cast<std::size_t>(edgeBetween(corner(n), corner(n + 1)))] =
        edgeBetween(corner(last), corner(last + 1));
  }
}

/// First vertex of a loop from which no inner edge of the fan lies in a face.
constexpr int fanStart(const Loop& loop) {
  for (int start = 0; start < loop.length; ++start) {
    bool inside = true;
    for (int n = 2; n + 1 < loop.length; ++n) inside = inside && !inOneFace(loop.at(start), loop.at(start + n));
    if (inside) return start;
  }
  throw std::logic_error("a loop without a fan");  // a compile error: the table is made at compile time
}

constexpr void addFan(CubeCase& to, const Loop& loop) {
  const int start = fanStart(loop);
  for (int n = 1; n + 1 < loop.length; ++n, ++to.triangle_count)
    for (int corner = 0; corner < 3; ++corner)
      to.edge[static_cast<std::size_t>(3 * to.triangle_count + corner)] =
          static_cast<std::uint8_t>(loop.at(start + (corner == 0 ? 0 : n + corner - 1)));
}

constexpr CubeCase caseOf(int solid_corners) {
  Lines lines;
  lines.fill(-1);
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) addFace(lines, solid_corners, axis, side);

  // Follow the lines, each once.
  CubeCase result;
  for (int first = 0; first < kCubeEdges; ++first) {
    Loop loop;
    for (int edge = first; lines[static_cast<std::size_t>(edge)] >= 0;) {
      loop.add(edge);
      const int next = lines[static_cast<std::size_t>(edge)];
      lines[static_cast<std::size_t>(edge)] = -1;
      edge = next;
    }
    if (loop.length > 0) addFan(result, loop);
  }
  return result;
}

constexpr std::array<CubeCase, 256> allCases() {
  std::array<CubeCase, 256> cases;
  for (int solid_corners = 0; solid_corners < 256; ++solid_corners)
    cases[static_cast<std::size_t>(solid_corners)] = caseOf(solid_corners);
  return cases;
}

constexpr std::array<CubeCase, 256> kCases = allCases();

}  // namespace

const CubeCase& cubeCase(int solid_corners) { return kCases[static_cast<std::size_t>(solid_corners)]; }

}  // namespace assets
