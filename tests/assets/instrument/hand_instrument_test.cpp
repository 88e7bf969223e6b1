#include "assets/instrument/hand_instrument.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "haptics/tool/hand_instrument.h"
#include "tests/assets/instrument/part_named.h"
#include "tests/assets/mesh/closed_mesh.h"

namespace assets {
namespace {

constexpr HandInstrumentForm kHandForms[] = {
    HandInstrumentForm::scalpel_15,    HandInstrumentForm::periosteal,  HandInstrumentForm::curette,
    HandInstrumentForm::bone_file,     HandInstrumentForm::suction,     HandInstrumentForm::composite,
    HandInstrumentForm::glass_ionomer, HandInstrumentForm::amalgam,     HandInstrumentForm::wax,
    HandInstrumentForm::gutta_percha,  HandInstrumentForm::plugger,     HandInstrumentForm::carver,
    HandInstrumentForm::curing_lamp,   HandInstrumentForm::root_plugger};

TEST(HandInstrument, IsMadeOfClosedSurfacesWithoutHandles) {
  for (const HandInstrumentForm form : kHandForms)
    for (const MeshPart& part : handInstrument(form).parts) {
      EXPECT_EQ(test::opennessOf(part.triangles), "") << part.name;
      EXPECT_EQ(test::eulerCharacteristic(part.triangles), 2) << part.name;
      EXPECT_GT(test::volume(part), 0.0) << part.name << " " << static_cast<int>(form);
    }
}

TEST(HandInstrument, HasFiniteUnitNormals) {
  for (const HandInstrumentForm form : kHandForms)
    for (const MeshPart& part : handInstrument(form).parts) {
      ASSERT_EQ(part.normal.size(), part.position_mm.size());
      for (const glm::vec3& p : part.position_mm) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << part.name;
      for (const glm::vec3& n : part.normal) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << part.name;
    }
}

TEST(HandInstrument, TipIsDrawnWhereTheBallThatIsFeltEnds) {
  for (const HandInstrumentForm form : kHandForms) {
    float low_mm = 1e9f;
    const MeshModel model = handInstrument(form);
    for (const glm::vec3& p : tests::partNamed(model, "Blade").position_mm) low_mm = std::min(low_mm, p.z);
    const auto size = haptics::kHandInstrumentSizes[static_cast<std::size_t>(form) + 1];
    EXPECT_NEAR(low_mm, -size.tip_radius_mm, 0.02) << static_cast<int>(form);
  }
}

TEST(HandInstrument, ScalpelIsThinAndCutsTowardsMinusY) {
  const MeshModel model = handInstrument(HandInstrumentForm::scalpel_15);
  float thickest_mm = 0.0f, thickest_at_edge_mm = 0.0f, edge_mm = 1e9f;
  for (const glm::vec3& p : tests::partNamed(model, "Blade").position_mm) edge_mm = std::min(edge_mm, p.y);
  for (const glm::vec3& p : tests::partNamed(model, "Blade").position_mm) {
    thickest_mm = std::max(thickest_mm, std::abs(p.x));
    if (p.z > 3.0f && p.z < 10.0f && p.y < -1.2f) thickest_at_edge_mm = std::max(thickest_at_edge_mm, std::abs(p.x));
  }
  EXPECT_NEAR(thickest_mm, 0.19f, 0.02f);
  EXPECT_LT(thickest_at_edge_mm, 0.08f);
}

}  // namespace
}  // namespace assets
