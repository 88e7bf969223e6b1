// Closed meshes as solid fractions, and STL files read: volumes of bodies, closedness, what is refused.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>

#include <glm/gtc/quaternion.hpp>

#include "assets/load_error.h"
#include "assets/mesh/mesh_solid.h"
#include "assets/mesh/stl_read.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace assets {
namespace {

using testing::HasSubstr;

/// A ball by halving the faces of an octahedron.
std::vector<StlTriangle> ball(double radius_mm, const glm::dvec3& middle_mm, int halvings) {
  std::vector<StlTriangle> mesh;
  for (int n = 0; n < 8; ++n) {
    const glm::dvec3 x(n & 1 ? -1.0 : 1.0, 0.0, 0.0), y(0.0, n & 2 ? -1.0 : 1.0, 0.0), z(0.0, 0.0, n & 4 ? -1.0 : 1.0);
    const bool is_even = ((n & 1) + (n >> 1 & 1) + (n >> 2)) % 2 == 0;
    mesh.push_back(is_even ? StlTriangle{x, y, z} : StlTriangle{y, x, z});
  }
  for (int n = 0; n < halvings; ++n) {
    std::vector<StlTriangle> finer;
    for (const auto& [a, b, c] : mesh) {
      // The same place from either face of an edge.
      const auto between = [](const glm::dvec3& p, const glm::dvec3& q) { return glm::normalize(p + q); };
      const glm::dvec3 ab = between(a, b), bc = between(b, c), ca = between(c, a);
      for (const StlTriangle& one : {StlTriangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(one);
    }
    mesh = std::move(finer);
  }
  for (StlTriangle& triangle : mesh)
    for (glm::dvec3& p : triangle) p = middle_mm + radius_mm * p;
  return mesh;
}

/// Of all within.
double meshVolume_mm3(const std::vector<StlTriangle>& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh) sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  return sum;
}

double volume_mm3(const std::vector<std::uint8_t>& solid, const VolumeGrid& grid) {
  return std::accumulate(solid.begin(), solid.end(), 0.0) / 255.0 * grid.voxelVolume_mm3();
}

const VolumeGrid kGrid{{60, 56, 52}, 0.1, {-3.0, -2.8, -2.6}};

std::string binaryOf(const std::vector<StlTriangle>& mesh, const std::string& header = "") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(mesh.size()));
  for (const StlTriangle& triangle : mesh) {
    put(glm::vec3(0.0f));
    for (const glm::dvec3& p : triangle) put(glm::vec3(p));
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string textOf(const std::vector<StlTriangle>& mesh) {
  std::ostringstream text;
  text.precision(9);
  text << "solid tooth\n";
  for (const StlTriangle& triangle : mesh) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const glm::dvec3& p : triangle) text << "      vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid tooth\n";
  return text.str();
}

TEST(MeshSolid, FillsABallToItsVolume) {
  const auto mesh = ball(2.0, {0.03, -0.02, 0.01}, 4);
  EXPECT_EQ(openEdges(mesh), 0u);
  const auto solid = solidOfMesh(mesh, kGrid);
  EXPECT_NEAR(volume_mm3(solid, kGrid) / meshVolume_mm3(mesh), 1.0, 0.002);
  EXPECT_NEAR(meshVolume_mm3(mesh), 4.0 / 3.0 * std::numbers::pi * 8.0, 0.3);
  // Its border lies where it should: a voxel whose middle is on the surface is half full, on average.
  double sum = 0.0, count = 0.0;
  forVoxels(kGrid, [&](glm::ivec3 ijk, std::size_t v) {
    const double r = glm::distance(kGrid.centre_P_mm(ijk), glm::dvec3(0.03, -0.02, 0.01));
    if (r < 1.9 - 0.06) {
      ASSERT_EQ(solid[v], 255);
    }
    if (r > 2.0 + 0.1) {
      ASSERT_EQ(solid[v], 0);
    }
    if (std::abs(r - 1.995) < 0.02) sum += solid[v] / 255.0, count += 1.0;
  });
  EXPECT_NEAR(sum / count, 0.5, 0.05);
}

TEST(MeshSolid, WhereFacesAndRaysMeetExactlyNothingLeaks) {
  // A box whose faces and diagonals lie on rays: 2 by 2 by 2 mm.
  std::vector<StlTriangle> box;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double w) {
        glm::dvec3 p(0.0);
        p[axis] = side, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = w;
        return p;
      };
      StlTriangle a{corner(-1, -1), corner(1, -1), corner(1, 1)}, b{corner(-1, -1), corner(1, 1), corner(-1, 1)};
      if (side < 0.0) std::swap(a[1], a[2]), std::swap(b[1], b[2]);
      box.push_back(a), box.push_back(b);
    }
  EXPECT_EQ(openEdges(box), 0u);
  for (const double off_mm : {0.0, 0.05, 1.0 / 60.0, 0.1 / 3.0}) {
    const VolumeGrid grid{{40, 40, 40}, 0.1, glm::dvec3(-1.95 + off_mm)};
    const auto solid = solidOfMesh(box, grid);
    // Rays on both faces are one more, a third of a voxel, across and up: 2.033 mm each.
    EXPECT_NEAR(volume_mm3(solid, grid), 8.0, 0.28) << off_mm;
    for (std::size_t v = 0; v < solid.size(); ++v) {
      const glm::dvec3 p = glm::abs(grid.centre_P_mm(elementAt(grid.size, v)));
      if (std::max({p.x, p.y, p.z}) > 1.06) {
        ASSERT_EQ(solid[v], 0) << off_mm;
      }
    }
  }
}

TEST(MeshSolid, IsTheSameInsideOutTurnedAndOverlapping) {
  auto mesh = ball(1.5, glm::dvec3(0.0), 3);
  const auto solid = solidOfMesh(mesh, kGrid);
  auto turned = mesh;
  for (StlTriangle& triangle : turned) std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(openEdges(turned), 0u);
  EXPECT_TRUE(solidOfMesh(turned, kGrid) == solid);
  const auto other = ball(1.5, glm::dvec3(0.4, 0.0, 0.0), 3);
  mesh.insert(mesh.end(), other.begin(), other.end());
  EXPECT_EQ(openEdges(mesh), 0u);
  const auto both = solidOfMesh(mesh, kGrid), alone = solidOfMesh(other, kGrid);
  for (std::size_t v = 0; v < both.size(); ++v) ASSERT_GE(both[v] + 1, std::max(solid[v], alone[v]));
}

TEST(MeshSolid, RandomClosedMeshesAgreeWithTheirVolume) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    auto mesh = ball(1.0, glm::dvec3(0.0), 3);
    const glm::dquat turn = glm::normalize(glm::dquat(any(random), any(random), any(random), any(random)));
    const glm::dvec3 scale(1.2 + 0.7 * any(random), 1.2 + 0.7 * any(random), 1.2 + 0.7 * any(random));
    for (StlTriangle& triangle : mesh)
      for (glm::dvec3& p : triangle) p = glm::dvec3(glm::vec3(turn * (scale * p)));
    ASSERT_EQ(openEdges(mesh), 0u) << seed;
    EXPECT_NEAR(volume_mm3(solidOfMesh(mesh, kGrid), kGrid) / meshVolume_mm3(mesh), 1.0, 0.01) << seed;
  }
}

TEST(MeshSolid, AHoleIsCounted) {
  auto mesh = ball(1.0, glm::dvec3(0.0), 2);
  mesh.pop_back();
  EXPECT_EQ(openEdges(mesh), 3u);
}

TEST(StlRead, BinaryAndTextHoldTheSame) {
  const auto mesh = ball(2.0, {1.0, -2.0, 3.0}, 2);
  const auto binary = stlTriangles(binaryOf(mesh), "t.stl"), text = stlTriangles(textOf(mesh), "t.stl");
  ASSERT_EQ(binary.size(), mesh.size());
  ASSERT_EQ(text.size(), mesh.size());
  for (std::size_t t = 0; t < mesh.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LT(glm::distance(binary[t][c], mesh[t][c]), 1e-6);
      EXPECT_LT(glm::distance(text[t][c], mesh[t][c]), 1e-6);
    }
  EXPECT_EQ(openEdges(text), 0u);
  // Many programs begin a binary file so.
  EXPECT_EQ(stlTriangles(binaryOf(mesh, "solid made by a scanner"), "t.stl").size(), mesh.size());
}

TEST(StlRead, RefusesInOneLine) {
  const auto mesh = ball(1.0, glm::dvec3(0.0), 0);
  const auto refusal = [](const std::string& bytes) {
    return tests::refusalOf<LoadError>([&] { stlTriangles(bytes, "t.stl"); });
  };
  EXPECT_THAT(refusal(""), HasSubstr("no STL file"));
  EXPECT_THAT(refusal("solid nothing\nendsolid\n"), HasSubstr("holds no triangle"));
  EXPECT_THAT(refusal(binaryOf(mesh) + "more"), HasSubstr("cut short, or no STL"));
  EXPECT_THAT(refusal(binaryOf({})), HasSubstr("holds no triangle"));
  const std::string text = textOf(mesh);
  EXPECT_THAT(refusal(text.substr(0, text.find("endfacet"))), HasSubstr("cut short"));
  auto far = mesh;
  far[3][1].y = 1e9;
  EXPECT_THAT(refusal(binaryOf(far)), HasSubstr("triangle 4"));
  far[3][1].y = std::nan("");
  EXPECT_THAT(refusal(binaryOf(far)), HasSubstr("triangle 4"));
}

TEST(StlReadMutants, AreRefusedInALineOrFilled) {
  const auto mesh = ball(2.0, glm::dvec3(0.0), 2);
  const VolumeGrid grid{{24, 24, 24}, 0.2, glm::dvec3(-2.3)};
  int refused = 0;
  mutants::forEachMutant({binaryOf(mesh), textOf(mesh)}, 4000,
                         [&](const std::string& mutant, std::size_t, std::uint64_t) {
                           const std::string said = tests::refusalOf<LoadError>([&] {
                             const auto triangles = stlTriangles(mutant, "t.stl");
                             openEdges(triangles);
                             solidOfMesh(triangles, grid);
                           });
                           if (said != "accepted") ++refused;
                         });
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace assets
