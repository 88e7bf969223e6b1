#include "assets/mesh/stl_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "assets/load_error.h"
#include "assets/mesh/bone_surface.h"
#include "tests/assets/mesh/closed_mesh.h"
#include "tests/assets/mesh/stl_reader.h"
#include "tests/scratch_folder.h"

namespace assets {
namespace {

class StlFile : public testing::Test {
 protected:
  tests::ScratchFolder folder_;
  std::string path_ = folder_.file("bone.stl");
};

MeshPart ball(const std::string& name) {
  const VolumeGrid grid{{20, 20, 20}, 0.5, {-5.0, -5.0, -5.0}};
  std::vector<std::uint8_t> solid(grid.voxelCount());
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i) {
        const double inside = 0.5 - (glm::length(grid.centre_P_mm({i, j, k})) - 3.3) / 1.0;
        solid[grid.index({i, j, k})] = static_cast<std::uint8_t>(255.0 * glm::clamp(inside, 0.0, 1.0));
      }
  return BoneSurface(SolidVoxels::inGridOrder(grid, solid)).mergedMesh(name);
}

TEST_F(StlFile, HoldsTheTrianglesAndTheirNormals) {
  const MeshPart mesh = ball("someone's name");
  calibration::OutputFile out(path_, true);
  writeStl({{mesh}}, out);
  const test::StlFile found = test::readStl(path_);
  ASSERT_EQ(found.mesh.triangles.size(), mesh.triangles.size());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    ASSERT_EQ(found.mesh.position_mm[found.mesh.triangles[n]], mesh.position_mm[mesh.triangles[n]]);
  EXPECT_EQ(test::opennessOf(found.mesh.triangles), "");
  EXPECT_EQ(test::eulerCharacteristic(found.mesh.triangles), 2);
  for (std::size_t t = 0; t < found.normal.size(); ++t) {
    ASSERT_NEAR(glm::length(found.normal[t]), 1.0f, 1e-5f);
    ASSERT_GT(glm::dot(found.normal[t], glm::normalize(mesh.position_mm[mesh.triangles[3 * t]])), 0.8f);
  }
}

TEST_F(StlFile, StatesOnlyUnitAndFrameInItsHeader) {
  calibration::OutputFile out(path_, true);
  writeStl({{ball("someone's name")}}, out);
  std::string header = test::readStl(path_).header;
  EXPECT_NE(header.find("SPACE=LPS"), std::string::npos);
  EXPECT_NE(header.find("UNIT=mm"), std::string::npos);
  EXPECT_FALSE(header.starts_with("solid"));
  header.erase(header.find_last_not_of(' ') + 1);
  EXPECT_EQ(header, "Molar surface. SPACE=LPS. UNIT=mm.");
}

TEST_F(StlFile, HoldsEveryPart) {
  const MeshPart mesh = ball("");
  calibration::OutputFile out(path_, true);
  writeStl({{mesh, mesh}}, out);
  EXPECT_EQ(test::readStl(path_).normal.size(), 2 * mesh.triangles.size() / 3);
}

TEST_F(StlFile, IsNotWrittenWithoutTriangles) {
  calibration::OutputFile out(path_, true);
  EXPECT_THROW(writeStl({}, out), LoadError);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace assets
