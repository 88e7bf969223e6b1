#include "assets/mesh/surface_patch.h"

#include <algorithm>
#include <array>

#include "assets/mesh/cube_cases.h"

namespace assets {
namespace {

constexpr double kIso = 127.5;              // solid = 0.5
constexpr int kEdge = kBrickVoxels + 2;     // the brick with one voxel on either side
constexpr std::uint16_t kNoVertex = 65535;  // a block has fewer edges

std::size_t indexOf(glm::ivec3 at) { return static_cast<std::size_t>((at.z * kEdge + at.y) * kEdge + at.x); }

/// The brick with its border; air outside the volume. `first` is the voxel at (0,0,0).
struct Block {
  glm::ivec3 first;
  std::array<std::uint8_t, kEdge * kEdge * kEdge> value{};
  std::array<std::uint32_t, kEdge * kEdge> solid_in_row{};  ///< bit i: voxel i of the row

  Block(const SolidVoxels& solid, glm::ivec3 brick) : first(kBrickVoxels * brick - 1) {
    const glm::ivec3 low = glm::max(first, glm::ivec3(0)), high = glm::min(first + kEdge, solid.grid.size);
    for (int k = low.z; k < high.z; ++k)
      for (int j = low.y; j < high.y; ++j) {
        const glm::ivec3 at = glm::ivec3(low.x, j, k) - first;
        std::uint8_t* const to = &value[indexOf(at)];
        std::copy_n(solid.from({low.x, j, k}), high.x - low.x, to);
        std::uint32_t& bits = solid_in_row[indexOf({0, at.y, at.z}) / kEdge];
        for (int n = 0; n < high.x - low.x; ++n) bits |= std::uint32_t{to[n] > kIso} << (at.x + n);
      }
  }

  std::uint32_t row(int j, int k) const { return solid_in_row[static_cast<std::size_t>(k * kEdge + j)]; }
};

/// Builds the patch; each crossed edge becomes one vertex.
class PatchMaker {
 public:
  PatchMaker(const VolumeGrid& grid, const Block& block) : grid_(grid), block_(block) { vertex_.fill(kNoVertex); }

  void addCell(glm::ivec3 cell, const CubeCase& triangles) {
    for (int n = 0; n < 3 * triangles.triangle_count; ++n)
      patch_.triangles.push_back(vertexOn(cell, triangles.edge[static_cast<std::size_t>(n)]));
  }
  SurfacePatch take() { return std::move(patch_); }

 private:
  std::uint32_t vertexOn(glm::ivec3 cell, int edge) {
    const int axis = edge / 4, corner = firstCorner(edge);
    const glm::ivec3 from = cell + cornerOffset(corner);
    std::uint16_t& vertex = vertex_[3 * indexOf(from) + static_cast<std::size_t>(axis)];
    if (vertex == kNoVertex) {
      vertex = static_cast<std::uint16_t>(patch_.position_P_mm.size());
      addVertex(from, axis);
    }
    return vertex;
  }

  void addVertex(glm::ivec3 from, int axis) {
    glm::ivec3 to = from;
    ++to[axis];
    const double a = block_.value[indexOf(from)], b = block_.value[indexOf(to)];
    const glm::ivec3 voxel = block_.first + from;
    glm::dvec3 index(voxel);
    index[axis] += (kIso - a) / (b - a);
    patch_.position_P_mm.emplace_back(grid_.origin_P_mm + grid_.spacing_mm * index);
    // Edges begin in the volume or one voxel before it.
    const glm::u64vec3 n(voxel + 1), wide(grid_.size + 1);
    patch_.lattice_edge.push_back(3 * ((n.z * wide.y + n.y) * wide.x + n.x) + static_cast<std::uint64_t>(axis));
  }

  const VolumeGrid& grid_;
  const Block& block_;
  std::array<std::uint16_t, 3 * kEdge * kEdge * kEdge> vertex_;
  SurfacePatch patch_;
};

}  // namespace

SurfacePatch surfacePatch(const SolidVoxels& solid, glm::ivec3 brick) {
  const Block block(solid, brick);
  // Border cells belong to the previous brick, if there is one.
  const glm::ivec3 first = glm::min(brick, glm::ivec3(1));
  PatchMaker maker(solid.grid, block);
  for (int k = first.z; k + 1 < kEdge; ++k)
    for (int j = first.y; j + 1 < kEdge; ++j) {
      // A row of cells between four rows that are all solid or all air has no surface.
      const std::array<std::uint32_t, 4> rows{block.row(j, k), block.row(j + 1, k), block.row(j, k + 1),
                                              block.row(j + 1, k + 1)};
      constexpr std::uint32_t kAll = (1u << kEdge) - 1;
      if ((rows[0] | rows[1] | rows[2] | rows[3]) == 0 || (rows[0] & rows[1] & rows[2] & rows[3]) == kAll) continue;
      for (int i = first.x; i + 1 < kEdge; ++i) {
        const auto two = [i](std::uint32_t row) { return row >> i & 3; };
        const auto corners = static_cast<int>(two(rows[0]) | two(rows[1]) << 2 | two(rows[2]) << 4 | two(rows[3]) << 6);
        if (corners != 0 && corners != 255) maker.addCell({i, j, k}, cubeCase(corners));
      }
    }
  return maker.take();
}

}  // namespace assets
