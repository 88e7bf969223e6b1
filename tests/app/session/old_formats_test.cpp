// Sessions recorded by the programs before: 300 ticks on a block of bone, a command that changes much at tick 120,
// another at 220; closed and sealed.
#include <gtest/gtest.h>

#include "app/session/metrics.h"
#include "app/session/replay.h"
#include "app/session/session_reader.h"

namespace app {
namespace {

std::string recorded(const char* name) { return std::string(MOLAR_RECORDED_SESSIONS) + "/" + name; }

class OldFormats : public testing::TestWithParam<const char*> {};

TEST_P(OldFormats, AreReadAsTheyWereRecorded) {
  SessionReader session(recorded(GetParam()));
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_TRUE(session.closed());
  EXPECT_FALSE(session.isUnsealed());
  const StoredStart start = session.start();
  EXPECT_EQ(start.patient_title, "block of bone");
  EXPECT_EQ(start.program_version, "0.1.0");
  EXPECT_EQ(start.grid.size, glm::ivec3(41, 41, 26));
  EXPECT_EQ(start.label[start.grid.index({3, 3, 2})], 4);
  ASSERT_EQ(session.events().size(), 1u);
  EXPECT_EQ(session.events()[0].text, "the canal is near");

  std::vector<haptics::Tick> ticks;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    EXPECT_EQ(block.removed_mm3, std::nullopt);
    ticks.insert(ticks.end(), block.ticks.begin(), block.ticks.end());
  }
  ASSERT_EQ(ticks.size(), 300u);
  EXPECT_EQ(ticks[299].index, 299u);
  EXPECT_EQ(ticks[299].bone_digest, 0x0330b2830389040du);
  EXPECT_EQ(ticks[150].hand.X_PT.translation_mm.x, 2.0 * std::sin(9.0 * (150 * 0.001)));
  EXPECT_EQ(ticks[150].command_serial, 2u);
  EXPECT_EQ(ticks[150].contact_tissue, 1);
  EXPECT_EQ(ticks[10].state, haptics::SafetyState::active);
  EXPECT_FALSE(session.finalBone(start).has_value());
}

TEST_P(OldFormats, HaveTheirCommands) {
  const auto commands = SessionReader(recorded(GetParam())).commands();
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(commands[0].command.tool.head.radius_mm, 1.0);
  EXPECT_EQ(commands[1].first_tick, 120u);
  const haptics::Command& second = commands[1].command;
  EXPECT_EQ(second.serial, 2u);
  EXPECT_EQ(second.law.kind, haptics::LawKind::hertz);
  EXPECT_EQ(second.law.hertz.hertz_N_per_mm2, 2.5);
  EXPECT_EQ(second.law.damping_Ns_per_mm, 0.001);
  EXPECT_EQ(second.law.tissue.factor[4], 1.75);
  EXPECT_EQ(second.tool.head, (haptics::BurShape{haptics::ShapeKind::cone, 1.2, 1.5}));
  EXPECT_EQ(second.tool.shaft.radius_mm, 0.4);
  EXPECT_EQ(second.erosion.kind, haptics::ErosionKind::dose);
  EXPECT_EQ(second.erosion.tissue_factor[2], 3.25);
  EXPECT_FALSE(second.irrigating);
  EXPECT_EQ(second.spindle.commanded_rpm, 30000.0);
  EXPECT_EQ(second.safety.thresholds.release_s, 0.06);
  EXPECT_EQ(second.safety.thresholds.share_at_hottest, 0.25);
  EXPECT_EQ(second.safety.peak_joint_torque_Nmm, glm::dvec3(100.0, 200.0, 300.0));
  EXPECT_EQ(commands[2].command.rearm, 7u);
  // All that nobody changed is as it was.
  EXPECT_EQ(second.safety.slew_N_per_s, haptics::Command{}.safety.slew_N_per_s);
  EXPECT_EQ(second.law.machining.flutes, 8.0);
}

TEST_P(OldFormats, AreOfAnotherVersion) {
  const ReplayReport report = verify(recorded(GetParam()));
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_NE(report.line().find("recorded by another version (0.1.0 with servo revision 0"), std::string::npos)
      << report.line();
}

TEST_P(OldFormats, HaveTheirNumbers) {
  const SessionMetrics metrics = metricsOf(recorded(GetParam()));
  EXPECT_EQ(metrics.ticks, 300u);
  EXPECT_NEAR(metrics.drill_on_s, 0.2, 1e-9);
  EXPECT_NEAR(metrics.dry_drilling_s, 0.1, 1e-9);
  EXPECT_NEAR(metrics.path_mm, 3.3244648880955086, 1e-12);
  EXPECT_NEAR(metrics.max_force_N, 0.38092442813642136, 1e-12);
  EXPECT_NEAR(metrics.removed_mm3, 0.13665882352941205, 1e-12);
  // Found by running it again: whatever the machine, the same bone is cut.
  ASSERT_TRUE(metrics.removed_mm3_by_label.has_value());
  EXPECT_NEAR(metrics.removed_mm3_by_label->at("cortical"), 0.13665882352941178, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Recorded, OldFormats, testing::Values("schema_3.molar", "schema_4.molar"),
                         [](const auto& file) { return std::string(file.param).substr(0, 8); });

TEST(OldFormat, OfSchema4HasItsCalibration) {
  const auto calibration = SessionReader(recorded("schema_4.molar")).start().calibration;
  ASSERT_TRUE(calibration.has_value());
  EXPECT_EQ(calibrationText(*calibration),
            "red, 1.24 mm RMS of 16, 3 days old, used despite that: demonstration without a patient");
  EXPECT_FALSE(SessionReader(recorded("schema_3.molar")).start().calibration.has_value());
}

}  // namespace
}  // namespace app
