#include "assets/mesh/bone_surface.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

struct Volume {
  VolumeGrid grid;
  std::vector<std::uint8_t> values;
  SolidVoxels voxels() const { return SolidVoxels::inGridOrder(grid, values); }
};

/// Solid fraction of a signed distance, with a transition of two voxels.
Volume bodyOf(const VolumeGrid& grid, const std::function<double(glm::dvec3)>& distance_mm) {
  Volume volume{grid, std::vector<std::uint8_t>(grid.voxelCount())};
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const double part = 0.5 - distance_mm(grid.centre_P_mm({i, j, k})) / (2.0 * grid.spacing_mm);
        volume.values[grid.index({i, j, k})] = static_cast<std::uint8_t>(255.0 * glm::clamp(part, 0.0, 1.0) + 0.5);
      }
  return volume;
}

Volume ball(double spacing_mm, double radius_mm) {
  const int size = static_cast<int>(2.0 * radius_mm / spacing_mm) + 7;
  const VolumeGrid grid{{size, size + 1, size + 2}, spacing_mm, glm::dvec3(-0.5 * spacing_mm * size)};
  return bodyOf(grid, [=](glm::dvec3 p) { return glm::length(p) - radius_mm; });
}

Volume noise(std::mt19937& random, glm::ivec3 size) {
  Volume volume{{size, 0.3, {-1.0, 2.0, 5.0}}, {}};
  std::uniform_int_distribution<int> value(0, 255);
  for (std::size_t v = 0; v < volume.grid.voxelCount(); ++v)
    volume.values.push_back(static_cast<std::uint8_t>(value(random)));
  return volume;
}

const std::vector<glm::ivec3> kSizes{{1, 1, 1}, {8, 8, 8}, {9, 8, 7}, {16, 17, 15}, {25, 3, 18}};

TEST(BoneSurface, IsASphereAroundABall) {
  const MeshPart mesh = BoneSurface(ball(0.4, 4.0).voxels()).mergedMesh("ball");
  EXPECT_EQ(test::opennessOf(mesh.triangles), "");
  EXPECT_EQ(test::eulerCharacteristic(mesh.triangles), 2);
  EXPECT_EQ(mesh.name, "ball");
}

TEST(BoneSurface, HasOneHoleAroundATorus) {
  const Volume torus = bodyOf({{40, 41, 20}, 0.3, {-6.0, -6.0, -3.0}}, [](glm::dvec3 p) {
    return glm::length(glm::dvec2(glm::length(glm::dvec2(p)) - 3.5, p.z)) - 1.5;
  });
  const MeshPart mesh = BoneSurface(torus.voxels()).mergedMesh("");
  EXPECT_EQ(test::opennessOf(mesh.triangles), "");
  EXPECT_EQ(test::eulerCharacteristic(mesh.triangles), 0);
}

TEST(BoneSurface, MeasuresABallWithinTheSquareOfTheSpacing) {
  constexpr double kRadius_mm = 3.0, kPi = 3.14159265358979323846;
  for (const double spacing_mm : {0.4, 0.2}) {
    const MeshPart mesh = BoneSurface(ball(spacing_mm, kRadius_mm).voxels()).mergedMesh("");
    // A chord of length h leaves h^2 / 8R between it and the sphere.
    const double gap_mm = spacing_mm * spacing_mm / (4.0 * kRadius_mm);
    EXPECT_NEAR(test::volume(mesh), 4.0 / 3.0 * kPi * std::pow(kRadius_mm, 3),
                4.0 * kPi * kRadius_mm * kRadius_mm * gap_mm);
    EXPECT_NEAR(test::area(mesh), 4.0 * kPi * kRadius_mm * kRadius_mm, 8.0 * kPi * kRadius_mm * gap_mm);
    for (const glm::vec3& p : mesh.position_mm) ASSERT_NEAR(glm::length(glm::dvec3(p)), kRadius_mm, gap_mm + 0.005);
  }
}

TEST(BoneSurface, HasNormalsThatPointIntoTheAir) {
  const MeshPart mesh = BoneSurface(ball(0.3, 3.0).voxels()).mergedMesh("");
  ASSERT_EQ(mesh.normal.size(), mesh.position_mm.size());
  for (std::size_t v = 0; v < mesh.normal.size(); ++v)
    ASSERT_GT(glm::dot(mesh.normal[v], glm::normalize(mesh.position_mm[v])), 0.99f);
}

TEST(BoneSurface, HasItsVerticesWhereTheFieldCrossesOneHalfOnLatticeEdges) {
  std::mt19937 random(1);
  const Volume volume = noise(random, {18, 9, 11});
  const VolumeGrid& grid = volume.grid;
  const auto valueAt = [&](glm::ivec3 ijk) {
    return grid.contains(ijk) ? double{1} * volume.values[grid.index(ijk)] : 0.0;
  };
  const BoneSurface surface(volume.voxels());
  int vertices = 0;
  for (int z = 0; z < grid.bricks().z; ++z)
    for (int y = 0; y < grid.bricks().y; ++y)
      for (int x = 0; x < grid.bricks().x; ++x)
        for (const glm::vec3& p : surface.patch({x, y, z}).position_P_mm) {
          const glm::dvec3 index = grid.indexFromPoint(p), nearest = glm::round(index);
          // Between voxels along one axis, on voxels along the others.
          const glm::dvec3 off = glm::abs(index - nearest);
          const int axis = off.x > off.y ? (off.x > off.z ? 0 : 2) : (off.y > off.z ? 1 : 2);
          ASSERT_LT(off.x + off.y + off.z - off[axis], 1e-5);
          glm::ivec3 from(nearest);
          from[axis] = static_cast<int>(glm::floor(index[axis]));
          glm::ivec3 to = from;
          ++to[axis];
          const double t = index[axis] - from[axis];
          ASSERT_NEAR(glm::mix(valueAt(from), valueAt(to), t), 127.5, 0.01);
          ++vertices;
        }
  EXPECT_GT(vertices, 2000);
}

TEST(BoneSurface, IsClosedForAnyVolumeUpToItsBorder) {
  std::mt19937 random(2);
  for (int round = 0; round < 4; ++round)
    for (const glm::ivec3& size : kSizes) {
      const Volume volume = noise(random, size);
      ASSERT_EQ(test::opennessOf(BoneSurface(volume.voxels()).mergedMesh("").triangles), "") << size.x << " " << round;
    }
  const Volume full{{{9, 16, 8}, 0.3, {}}, std::vector<std::uint8_t>(9 * 16 * 8, 255)};
  const MeshPart box = BoneSurface(full.voxels()).mergedMesh("");
  EXPECT_EQ(test::opennessOf(box.triangles), "");
  EXPECT_EQ(test::eulerCharacteristic(box.triangles), 2);
}

TEST(BoneSurface, IsEmptyWithoutBone) {
  const Volume air{{{12, 9, 8}, 0.3, {}}, std::vector<std::uint8_t>(12 * 9 * 8, 127)};
  const BoneSurface surface(air.voxels());
  EXPECT_TRUE(surface.mergedMesh("").triangles.empty());
}

TEST(BoneSurface, HasBitEqualVerticesWherePatchesMeet) {
  std::mt19937 random(3);
  const Volume volume = noise(random, {17, 16, 24});
  const BoneSurface surface(volume.voxels());
  std::map<std::uint64_t, glm::vec3> known;
  int shared = 0;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) {
        const SurfacePatch& patch = surface.patch({x, y, z});
        for (std::size_t v = 0; v < patch.position_P_mm.size(); ++v) {
          const auto [at, is_new] = known.emplace(patch.lattice_edge[v], patch.position_P_mm[v]);
          ASSERT_EQ(at->second, patch.position_P_mm[v]);
          shared += is_new ? 0 : 1;
        }
      }
  EXPECT_GT(shared, 300);
}

bool same(const SurfacePatch& a, const SurfacePatch& b) {
  return a.position_P_mm == b.position_P_mm && a.lattice_edge == b.lattice_edge && a.triangles == b.triangles;
}

TEST(BoneSurface, EqualsAFullRebuildAfterCarving) {
  std::mt19937 random(4);
  Volume volume = ball(0.3, 4.0);
  const VolumeGrid& grid = volume.grid;
  const glm::ivec3 bricks = grid.bricks();
  BoneSurface surface(volume.voxels());
  std::uniform_int_distribution<int> axis_place(0, grid.size.x - 1);
  int remade = 0;
  for (int cut = 0; cut < 12; ++cut) {
    // Remove a ball of bone or a single voxel, also at brick borders.
    const glm::ivec3 centre = cut % 3 == 0 ? glm::ivec3(7 + 8 * (cut / 6), 15, 8)
                                           : glm::ivec3(axis_place(random), axis_place(random), axis_place(random));
    const int radius = cut % 3 == 0 ? 0 : 3;
    std::vector<glm::ivec3> changed;
    for (int k = -radius; k <= radius; ++k)
      for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) {
          const glm::ivec3 voxel = centre + glm::ivec3(i, j, k);
          if (!grid.contains(voxel) || i * i + j * j + k * k > radius * radius) continue;
          volume.values[grid.index(voxel)] /= 3;
          changed.push_back(voxel / kBrickVoxels);
        }
    remade += static_cast<int>(surface.update(volume.voxels(), changed).size());
    const BoneSurface anew(volume.voxels());
    for (int z = 0; z < bricks.z; ++z)
      for (int y = 0; y < bricks.y; ++y)
        for (int x = 0; x < bricks.x; ++x)
          ASSERT_TRUE(same(surface.patch({x, y, z}), anew.patch({x, y, z})))
              << cut << ": " << x << " " << y << " " << z;
  }
  EXPECT_GT(remade, 20);
  EXPECT_LT(remade, 12 * bricks.x * bricks.y * bricks.z / 2);
}

TEST(BoneSurface, ReadsVoxelsInsideALargerArray) {
  std::mt19937 random(5);
  const Volume volume = noise(random, {9, 10, 11});
  const VolumeGrid& grid = volume.grid;
  const glm::ivec3 wide = grid.size + 5;
  std::vector<std::uint8_t> array(static_cast<std::size_t>(wide.x * wide.y * wide.z), 200);
  const auto place = [&](glm::ivec3 v) { return static_cast<std::size_t>((v.z * wide.y + v.y) * wide.x + v.x); };
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        array[place(glm::ivec3(i, j, k) + 2)] = volume.values[grid.index({i, j, k})];
  const SolidVoxels inside{grid, array, place({2, 2, 2}), place({0, 1, 0}), place({0, 0, 1})};
  EXPECT_TRUE(same(surfacePatch(inside, {0, 0, 0}), surfacePatch(volume.voxels(), {0, 0, 0})));
  EXPECT_TRUE(same(surfacePatch(inside, {1, 1, 1}), surfacePatch(volume.voxels(), {1, 1, 1})));
}

}  // namespace
}  // namespace assets
