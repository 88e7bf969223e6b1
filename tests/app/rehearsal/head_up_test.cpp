#include "app/rehearsal/head_up.h"

#include <gtest/gtest.h>

#include "haptics/tool/spindle.h"

namespace app {
namespace {

using std::chrono::milliseconds;

struct Picture {
  HeadUp head_up{true, false};
  haptics::Tick tick;
  haptics::Command command;
  HeadUp::Time now{};
  bool ready = false, hints = true;

  Picture() { tick.dt_s = 0.001; }
  HeadUpContent at(milliseconds later, bool has_motors = false) {
    return head_up.content({{tick, command, has_motors}, 3.0, "", "", ready, {}, {}, {}, {}, hints}, now + later);
  }
};

TEST(HeadUp, ShowsWhatTheForcepsDoWhereADrillHasItsSpeed) {
  Picture picture;
  picture.command.tool = haptics::forcepsTool();
  EXPECT_EQ(picture.at(milliseconds(0)).bur, "extraction forceps");
  EXPECT_EQ(picture.at(milliseconds(0)).drive, "not ready");
  picture.ready = true;
  EXPECT_EQ(picture.at(milliseconds(0)).drive, "open");
  picture.tick.gripped = 1;
  picture.tick.torn_share = 0.42;
  EXPECT_EQ(picture.at(milliseconds(0)).drive, "torn 42 %");
}

TEST(HeadUp, AFilesLineStandsAboveTheOthersWhereItsCellHasNoRoom) {
  Picture picture;
  picture.command.tool = haptics::fileTool({.size = 15});
  const auto with = [&](const std::string& file) {
    HeadUp::Values values{{picture.tick, picture.command}, {}, "", "", false, "", "another way"};
    values.file = file;
    values.locator = HeadUpLocator{0.5, false};
    return picture.head_up.content(values, picture.now);
  };
  EXPECT_EQ(with("on the tooth").drive, "on the tooth");
  EXPECT_EQ(with("on the tooth").way, "another way");
  EXPECT_EQ(with("17.2 of 20.4 mm in the distal canal").drive, "in the tooth");
  EXPECT_EQ(with("17.2 of 20.4 mm in the distal canal").way, "17.2 of 20.4 mm in the distal canal");
  ASSERT_TRUE(with("free").locator);
  EXPECT_EQ(with("free").locator->left_mm, 0.5);
}

TEST(HeadUp, ShowsTheTorqueOfAnElevatorInsteadOfTheForce) {
  Picture picture;
  EXPECT_FALSE(picture.at(milliseconds(0)).torque_Nmm);
  picture.command.tool = haptics::elevatorTool(haptics::ElevatorKind::straight_301);
  EXPECT_EQ(picture.at(milliseconds(0)).drive, "not ready");
  picture.ready = true;
  EXPECT_EQ(picture.at(milliseconds(0)).drive, "free");
  picture.tick.lever.piece = 1;
  picture.tick.lever.twist_Nmm = -500.0;
  picture.tick.torn_share = 0.42;
  const HeadUpContent shown = picture.at(milliseconds(0));
  EXPECT_EQ(shown.drive, "torn 42 %");
  EXPECT_EQ(shown.torque_Nmm, 500.0);
  EXPECT_EQ(shown.torque_share, 0.25);
}

TEST(HeadUp, SaysALineForTwoSecondsFromItsFirstFrame) {
  Picture picture;
  EXPECT_EQ(picture.at(milliseconds(0)).said, "");
  picture.head_up.say("irrigation on");
  EXPECT_EQ(picture.at(milliseconds(500)).said, "irrigation on");
  EXPECT_EQ(picture.at(milliseconds(2499)).said, "irrigation on");
  EXPECT_EQ(picture.at(milliseconds(2500)).said, "");
  picture.head_up.say(std::string(60, 'x'));
  EXPECT_NE(picture.at(milliseconds(3000)).said, "");
  EXPECT_NE(picture.at(milliseconds(6500)).said, "") << "longer to read";
  EXPECT_EQ(picture.at(milliseconds(6700)).said, "");
}

TEST(HeadUp, SaysHowToDrillWhereABurRestsOnBoneAndHasNeverTurned) {
  Picture picture;
  EXPECT_EQ(picture.at(milliseconds(0)).said, "") << "off the bone";
  picture.tick.depth_mm = 0.1;
  EXPECT_EQ(picture.at(milliseconds(0)).said, "hold Space to drill");
  picture.hints = false;
  EXPECT_EQ(picture.at(milliseconds(0)).said, "") << "nobody works, a recording is looked at";
  picture.hints = true;
  EXPECT_EQ(picture.at(milliseconds(0), true).said, "") << "a device has a pedal or a button";
  picture.command.tool = haptics::elevatorTool(haptics::ElevatorKind::straight_301);
  EXPECT_EQ(picture.at(milliseconds(0)).said, "");
  picture.command.tool = {};
  picture.tick.spindle_rad_per_s = haptics::radPerSecond(-39'800.0);
  EXPECT_EQ(picture.at(milliseconds(0)).said, "");
  picture.tick.spindle_rad_per_s = 0.0;
  EXPECT_EQ(picture.at(milliseconds(0)).said, "") << "known by now";
}

TEST(HeadUp, ShowsTheKeysOfTheTableUntilF1OrEsc) {
  Picture picture;
  EXPECT_TRUE(picture.at(milliseconds(0)).keys.empty());
  EXPECT_TRUE(picture.head_up.execute({Control::keys}));
  const auto keys = picture.at(milliseconds(0), true).keys;
  const auto has = [&](std::string_view key) {
    return std::ranges::any_of(keys, [&](const auto& one) { return one.first == key; });
  };
  for (const ControlMeaning& one : kControls)
    EXPECT_EQ(has(one.key), !one.key.empty() && one.control != Control::law) << one.name;
  EXPECT_LT(picture.at(milliseconds(0)).keys.size(), keys.size()) << "nobody with a mouse is told of motors";
  EXPECT_TRUE(picture.head_up.closeKeys());
  EXPECT_FALSE(picture.head_up.closeKeys()) << "Esc then has its own meaning";
  EXPECT_TRUE(picture.at(milliseconds(0)).keys.empty());
}

TEST(HeadUp, SwitchesTheLine) {
  Picture picture;
  EXPECT_TRUE(picture.at(milliseconds(0)).line_shown);
  EXPECT_TRUE(picture.head_up.execute({Control::line}));
  EXPECT_FALSE(picture.at(milliseconds(0)).line_shown);
  EXPECT_TRUE(picture.head_up.execute({Control::line, 0}));
  EXPECT_FALSE(picture.at(milliseconds(0)).line_shown);
  EXPECT_FALSE(picture.head_up.execute({Control::undo})) << "another control";
}

TEST(HeadUp, NamesBurSpeedAndForce) {
  Picture picture;
  picture.command.tool.head = {haptics::ShapeKind::sphere, 1.5, 0.0};
  picture.command.safety.peak_force_N = 4.0;
  picture.tick.commanded_force_P_N = {{0.0, 1.0, 0.0}};
  picture.tick.spindle_rad_per_s = haptics::radPerSecond(-39'800.0);
  HeadUpContent content = picture.at(milliseconds(0));
  EXPECT_EQ(content.bur, "round 3.0 mm, ISO 030");
  EXPECT_EQ(content.drive, "40,000 rpm");
  EXPECT_DOUBLE_EQ(content.force_share, 0.25);
  EXPECT_EQ(content.gap_mm, 3.0);
  picture.tick.depth_mm = 0.1;
  picture.tick.spindle_rad_per_s = 0.0;
  picture.command.drill_enabled = false;
  content = picture.at(milliseconds(0));
  EXPECT_EQ(content.gap_mm, 0.0) << "contact";
  EXPECT_EQ(content.drive, "drill locked");
}

}  // namespace
}  // namespace app
