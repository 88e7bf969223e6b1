#include "assets/instrument/canal_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/assets/instrument/part_named.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

// Steel where nothing turns it, amber at 0.4 of what breaks it, red at all of it.
TEST(CanalFile, IsColouredByItsTorquePlaceByPlace) {
  const DrawnFile plain{.file = *kFile(20, 25, KFileMetal::steel), .node_T_mm = {}, .torque_share = {}};
  const MeshModel steel = canalFile(plain);
  for (const glm::vec4& colour : tests::partNamed(steel, "Wire").colour) {
    EXPECT_NEAR(colour.r, colour.b, 0.05) << "grey";
    EXPECT_EQ(colour.a, 1.0f);
  }
  const std::array<float, 3> share{1.0f, 0.4f, 0.0f};
  DrawnFile strained = plain;
  strained.torque_share = share;
  const MeshPart wire = tests::partNamed(canalFile(strained), "Wire");
  ASSERT_EQ(wire.colour.size(), wire.position_mm.size());
  for (std::size_t n = 0; n < wire.colour.size(); ++n) {
    const float along = -wire.position_mm[n].z / 25.0f;
    const glm::vec4& c = wire.colour[n];
    if (along < 0.02f) {
      EXPECT_GT(c.r, 10.0f * c.g) << "red at the handle";
      EXPECT_GT(c.r, 0.7f);
    } else if (std::fabs(along - 0.5f) < 0.01f) {
      EXPECT_GT(c.g, 0.3f);
      EXPECT_LT(c.b, 0.1f) << "amber in the middle";
    } else if (along > 0.98f) {
      EXPECT_NEAR(c.r, c.b, 0.1f) << "grey at the tip";
    }
  }
}

TEST(CanalCone, IsAsThickAsItsSizeAndTaperSayAndGoneOnceItIsLetGoOf) {
  std::vector<glm::vec3> nodes;
  for (int n = 0; n <= 32; ++n) nodes.emplace_back(0.0f, 0.0f, -21.0f * static_cast<float>(n) / 32.0f);
  DrawnCone drawn{.cone = *guttaPerchaCone(30, 0.04, 21.0), .node_T_mm = nodes};
  const MeshModel model = canalCone(drawn);
  for (const MeshPart& part : model.parts) {
    EXPECT_EQ(test::opennessOf(part.triangles), "") << part.name;
    EXPECT_GT(test::volume(part), 0.0) << part.name;
  }
  float low_mm = 0.0f;
  for (const glm::vec3& p : tests::partNamed(model, "Cone").position_mm) {
    low_mm = std::min(low_mm, p.z);
    EXPECT_LE(std::hypot(p.x, p.y), 0.15f + 0.02f * (p.z + 21.0f) + 2e-3f);
    if (p.z > -20.0f && std::hypot(p.x, p.y) > 0.01f) {
      EXPECT_NEAR(std::hypot(p.x, p.y), 0.15f + 0.02f * (p.z + 21.0f), 2e-3f);
    }
  }
  EXPECT_NEAR(low_mm, -21.0f, 0.02f);
  drawn.is_held = false;
  EXPECT_EQ(canalCone(drawn).parts.size(), model.parts.size() - 1);
}

}  // namespace
}  // namespace assets
