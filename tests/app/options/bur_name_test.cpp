#include "app/options/bur_name.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using haptics::ShapeKind;

TEST(BurName, IsShapeDiameterAndIsoSize) {
  EXPECT_EQ(burName({ShapeKind::sphere, 1.5, 0.0}), "round 3.0 mm, ISO 030");
  EXPECT_EQ(burName({ShapeKind::sphere, 1.15, 0.0}), "round 2.3 mm, ISO 023");
  EXPECT_EQ(burName({ShapeKind::cylinder, 0.8, 4.5}), "fissure 1.6 mm, ISO 016");
  EXPECT_EQ(burName({ShapeKind::capsule, 0.6, 4.0}), "round-end fissure 1.2 mm, ISO 012");
  EXPECT_EQ(burName({ShapeKind::cone, 1.0, 5.0}), "cone 2.0 mm, ISO 020");
  EXPECT_EQ(burName({ShapeKind::revolved, 0.8, 8.0, assets::BurProfile::round_taper}),
            "round-end taper 1.6 mm, ISO 016");
}

TEST(BurName, NamesInstrumentsThatAreNoBurs) {
  EXPECT_EQ(toolName(haptics::forcepsTool()), "extraction forceps");
  EXPECT_EQ(toolName(haptics::elevatorTool(haptics::ElevatorKind::straight_301)), "elevator 301");
  EXPECT_EQ(toolName(haptics::elevatorTool(haptics::ElevatorKind::straight_34s)), "elevator 34S");
  EXPECT_EQ(toolName(haptics::elevatorTool(haptics::ElevatorKind::cryer_left)), "Cryer elevator left");
  EXPECT_EQ(toolName(haptics::elevatorTool(haptics::ElevatorKind::cryer_right)), "Cryer elevator right");
  EXPECT_EQ(toolName(haptics::handInstrumentTool(haptics::HandInstrument::scalpel_15)), "scalpel no. 15");
  EXPECT_EQ(toolName(haptics::handInstrumentTool(haptics::HandInstrument::suction)), "suction tip");
  EXPECT_EQ(toolName(haptics::handInstrumentTool(haptics::HandInstrument::composite)), "applicator, composite");
  EXPECT_EQ(toolName(haptics::handInstrumentTool(haptics::HandInstrument::curing_lamp)), "curing lamp");
}

TEST(BurName, HasNoIsoSizeBetweenTenths) { EXPECT_EQ(burName({ShapeKind::sphere, 0.925, 0.0}), "round 1.85 mm"); }

TEST(BurName, NamesAFileBySizeColourAndLength) {
  EXPECT_EQ(toolName(haptics::fileTool({25, 25.0})), "K-file 25 red, 25 mm");
  EXPECT_EQ(toolName(haptics::fileTool({10, 21.0, true, 30.0})), "K-file 10 purple, 21 mm, NiTi, bent 30°");
  haptics::CanalFile cone{.size = 30, .length_mm = 21.0};
  cone.cone_taper = 0.04, cone.sealer_mm3 = 2.0;
  EXPECT_EQ(toolName(haptics::fileTool(cone)), "gutta-percha cone 30, 4 %");
  cone.sealer_mm3 = 0.0;
  EXPECT_EQ(toolName(haptics::fileTool(cone)), "gutta-percha cone 30, 4 %, dry");
}

}  // namespace
}  // namespace app
