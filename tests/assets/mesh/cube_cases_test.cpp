#include "assets/mesh/cube_cases.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "assets/mesh/bone_surface.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

bool isSolid(int solid_corners, int corner) { return (solid_corners >> corner & 1) != 0; }

TEST(CubeCases, CrossesExactlyTheEdgesBetweenSolidAndAir) {
  for (int solid_corners = 0; solid_corners < 256; ++solid_corners) {
    const CubeCase& found = cubeCase(solid_corners);
    std::set<int> crossed;
    for (int n = 0; n < 3 * found.triangle_count; ++n) crossed.insert(found.edge[static_cast<std::size_t>(n)]);
    for (int edge = 0; edge < kCubeEdges; ++edge) {
      const int from = firstCorner(edge), to = from | 1 << edge / 4;
      EXPECT_EQ(crossed.contains(edge), isSolid(solid_corners, from) != isSolid(solid_corners, to))
          << solid_corners << " edge " << edge;
    }
  }
}

// Eight voxels in air (or in bone): the surface has winding number 1 about each solid voxel, else 0.
TEST(CubeCases, SeparatesSolidFromAirInEveryCase) {
  for (const std::uint8_t around : {std::uint8_t{0}, std::uint8_t{255}})
    for (int solid_corners = 0; solid_corners < 256; ++solid_corners) {
      const VolumeGrid grid{{4, 4, 4}, 1.0, {0.0, 0.0, 0.0}};
      std::vector<std::uint8_t> values(grid.voxelCount(), around);
      for (int corner = 0; corner < 8; ++corner)
        values[grid.index(1 + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2))] =
            static_cast<std::uint8_t>(isSolid(solid_corners, corner) ? 140 + 14 * corner : 10 * corner);
      const MeshPart mesh = BoneSurface(SolidVoxels::inGridOrder(grid, values)).mergedMesh("");
      ASSERT_EQ(test::opennessOf(mesh.triangles), "") << solid_corners;
      for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 4; ++j)
          for (int i = 0; i < 4; ++i)
            ASSERT_NEAR(test::windingNumber(mesh, {i, j, k}), values[grid.index({i, j, k})] > 127 ? 1.0 : 0.0, 1e-5)
                << solid_corners << " at " << i << " " << j << " " << k;
    }
}

TEST(CubeCases, KeepsSolidCornersApartWhereAFaceAlternates) {
  EXPECT_EQ(cubeCase(0b00001001).triangle_count, 2);  // two corners of the face z = 0: each cut off by itself
  EXPECT_EQ(cubeCase(0b11110110).triangle_count, 4);  // the other way round air is joined: one loop of six
}

}  // namespace
}  // namespace assets
