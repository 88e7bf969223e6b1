#include "app/session/command_keys.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "app/session/compressed.h"
#include "app/session/session_error.h"
#include "app/session/session_text.h"
#include "tests/app/session/small_session.h"

namespace app {
namespace {

haptics::Command again(const haptics::Command& command) { return commandFromText(commandText(command)); }

TEST(CommandKeys, BringACommandBackBitForBit) {
  haptics::Command command;
  command.serial = 9;
  command.tool.head.radius_mm = 1.1;
  command.drill_enabled = false;
  command.irrigating = false;
  command.undo_serial = 0x0123456789abcdef;
  command.law.agus.stiffness_N_per_mm = 0.7;
  command.law.damping_Ns_per_mm = 0.002;
  command.erosion.time.removal_rate_per_s = 3.5;
  command.erosion.tissue_factor[4] = 0.123;
  command.safety = {2.9, 250.0, 60.0, 4000.0, 7.0, 0.004, 0.9, {1.0, 2.0, 3.0}, 2000.0, 90.0, true, {}};
  command.safety.thresholds.release_s = 0.06;
  command.safety.thresholds.share_at_hottest = 0.2;
  command.rearm = 5;
  EXPECT_EQ(commandText(again(command)), commandText(command));
  const haptics::Command back = again(command);
  EXPECT_EQ(back.serial, 9u);
  EXPECT_EQ(back.tool.head.radius_mm, 1.1);
  EXPECT_FALSE(back.drill_enabled);
  EXPECT_FALSE(back.irrigating);
  EXPECT_EQ(back.undo_serial, 0x0123456789abcdefu);
  EXPECT_EQ(back.law.damping_Ns_per_mm, 0.002);
  EXPECT_EQ(back.erosion.tissue_factor[4], 0.123);
  EXPECT_EQ(back.safety.slew_N_per_s, 250.0);
  EXPECT_EQ(back.safety.peak_torque_Nmm, 60.0);
  EXPECT_EQ(back.safety.slew_Nmm_per_s, 4000.0);
  EXPECT_EQ(back.safety.max_stiffness_N_per_mm, 7.0);
  EXPECT_EQ(back.safety.continuous_force_N, 0.9);
  EXPECT_EQ(back.safety.peak_joint_torque_Nmm, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_TRUE(back.safety.must_be_armed);
  EXPECT_EQ(back.safety.thresholds.release_s, 0.06);
  EXPECT_EQ(back.safety.thresholds.share_at_hottest, 0.2);
  EXPECT_EQ(back.rearm, 5u);
}

TEST(CommandKeys, KeepWhatIsNoFiniteNumber) {
  haptics::Command command;
  command.law.agus.stiffness_N_per_mm = std::numeric_limits<double>::infinity();
  command.law.hertz.hertz_N_per_mm2 = -std::numeric_limits<double>::infinity();
  command.erosion.worn = std::nan("");
  command.spindle.droop = -0.0;
  command.spindle.free_rpm = std::numeric_limits<double>::denorm_min();
  const haptics::Command back = again(command);
  EXPECT_EQ(back.law.agus.stiffness_N_per_mm, std::numeric_limits<double>::infinity());
  EXPECT_EQ(back.law.hertz.hertz_N_per_mm2, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(back.erosion.worn));
  EXPECT_TRUE(std::signbit(back.spindle.droop));
  EXPECT_EQ(back.spindle.free_rpm, std::numeric_limits<double>::denorm_min());
}

TEST(CommandKeys, NameLawsShapesAndTissues) {
  haptics::Command command;
  command.law.kind = haptics::LawKind::harmonic;
  command.erosion.kind = haptics::ErosionKind::dose;
  command.tool.head.kind = haptics::ShapeKind::cone;
  command.tool.elevator = haptics::ElevatorKind::cryer_right;
  command.tool.hand_instrument = haptics::HandInstrument::curette;
  const std::string text = commandText(command);
  for (const char* part : {"\"law.kind\":\"harmonic\"", "\"erosion.kind\":\"dose\"", "\"tool.head.kind\":\"cone\"",
                           "\"law.tissue.factor.enamel\":1.5"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  const haptics::Command back = again(command);
  EXPECT_EQ(back.law.kind, haptics::LawKind::harmonic);
  EXPECT_EQ(back.erosion.kind, haptics::ErosionKind::dose);
  EXPECT_EQ(back.tool.head.kind, haptics::ShapeKind::cone);
  EXPECT_EQ(back.tool.elevator, haptics::ElevatorKind::cryer_right);
  EXPECT_EQ(back.tool.hand_instrument, haptics::HandInstrument::curette);
}

TEST(CommandKeys, NameTheOutlineOfARevolvedHead) {
  for (std::size_t n = 0; n < assets::kBurProfiles; ++n) {
    haptics::Command command;
    command.tool.head = {haptics::ShapeKind::revolved, 0.8, 8.0, static_cast<assets::BurProfile>(n)};
    EXPECT_NE(commandText(command).find("\"tool.head.kind\":\"revolved\""), std::string::npos);
    EXPECT_EQ(again(command).tool.head, command.tool.head);
  }
}

TEST(CommandKeys, OfAnotherProgramArePassedByAndMissingOnesDefaulted) {
  const haptics::Command read =
      commandFromText(R"({"serial":4,"law.kind":"gravity","coolant_ml_per_min":40,"nested":{"a":[1,2]}})");
  EXPECT_EQ(read.serial, 4u);
  EXPECT_EQ(read.law.kind, haptics::LawKind::agus) << "a law that is unknown here";
  EXPECT_EQ(read.spindle.commanded_rpm, haptics::Command{}.spindle.commanded_rpm);
}

TEST(CommandKeys, RefuseWhatCanNotBeRead) {
  for (const char* text : {"", "[]", "{", "{\"serial\":-1}", "{\"serial\":\"x\"}", "{\"irrigating\":1}",
                           "{\"spindle.droop\":\"big\"}", "{\"law.kind\":3}"})
    EXPECT_THROW(commandFromText(text), SessionError) << text;
}

TEST(SessionTexts, RefuseWhatIsNestedTooDeep) {
  const std::string nested = std::string(100'000, '[') + std::string(100'000, ']');
  const std::string about = aboutText(test::SmallBone().start());
  EXPECT_THROW(commandFromText("{\"x\":" + nested + "}"), SessionError);
  EXPECT_THROW(aboutFromText("{\"x\":" + nested + "," + about.substr(1)), SessionError);
  EXPECT_THROW(removedFromText("{\"x\":" + nested + "}"), SessionError);
  EXPECT_THROW(sealFromText("{\"x\":" + nested + "}"), SessionError);
  EXPECT_NO_THROW(aboutFromText("{\"x\":[[1]]," + about.substr(1)));
}

TEST(Compressed, RefusesAnythingButTheExpectedBytes) {
  const std::vector<std::uint8_t> bytes(1000, 42);
  std::vector<std::uint8_t> packed = Compressor().compress(bytes);
  EXPECT_EQ(decompress(packed, 1000), bytes);
  EXPECT_THROW(decompress(packed, 999), SessionError);
  packed.resize(packed.size() / 2);
  EXPECT_THROW(decompress(packed, 1000), SessionError);
  EXPECT_THROW(decompress({}, 1000), SessionError);
}

TEST(Compressed, AllocatesNothingForAFrameThatIsTooShortForWhatItPromises) {
  // A frame of one block that says it holds 2 GiB.
  const std::vector<std::uint8_t> lying = {0x28, 0xb5, 0x2f, 0xfd, 0xa0, 0, 0, 0, 0x80, 1, 0, 0};
  EXPECT_THROW(refuseUnlessContentSize(lying, 0x80000000u), SessionError);
}

}  // namespace
}  // namespace app
