#include "app/controls/control.h"

#include <gtest/gtest.h>

#include <set>

#include "app/text/usage_error.h"

namespace app {
namespace {

TEST(Control, HasOneNameAndOneKeyEach) {
  std::set<std::string_view> names, keys;
  for (const ControlMeaning& one : kControls) {
    EXPECT_EQ(controlNamed(one.name), one.control);
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_TRUE(one.key.empty() || keys.insert(one.key).second) << one.key;
    EXPECT_FALSE(one.does.empty()) << one.name;
  }
  EXPECT_FALSE(controlNamed("Undo"));
  EXPECT_FALSE(controlNamed(""));
}

TEST(Control, IsParsedFromText) {
  EXPECT_EQ(requestFrom("undo"), (ControlRequest{Control::undo}));
  EXPECT_EQ(requestFrom("irrigation"), (ControlRequest{Control::irrigation})) << "toggles";
  EXPECT_EQ(requestFrom("irrigation:off"), (ControlRequest{Control::irrigation, 0}));
  EXPECT_EQ(requestFrom("drill:on"), (ControlRequest{Control::drill, 1}));
  EXPECT_EQ(requestFrom("tool"), (ControlRequest{Control::tool})) << "the next one";
  EXPECT_EQ(requestFrom("face:30"), (ControlRequest{Control::face, 30}));
  EXPECT_EQ(requestFrom("tool:1").value, 0) << "counted from 1";
  EXPECT_EQ(requestFrom("law:3"), requestFrom("law:hertz")) << "by its key as well";
}

TEST(Control, NamesTheAcceptedValues) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      requestFrom(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_NE(refusal("dril").find("\"dril\": no such control, give law, drill, tool"), std::string::npos);
  EXPECT_NE(refusal("").find("no such control"), std::string::npos);
  EXPECT_NE(refusal("law").find("law takes one of agus, "), std::string::npos);
  EXPECT_NE(refusal("law:0").find("one of agus"), std::string::npos);
  EXPECT_NE(refusal("law:8").find("one of agus"), std::string::npos);
  EXPECT_NE(refusal("tool:0").find("number from 1"), std::string::npos);
  EXPECT_NE(refusal("tool:2x").find("number from 1"), std::string::npos);
  EXPECT_NE(refusal("undo:2").find("undo takes no value"), std::string::npos);
  EXPECT_NE(refusal("drill:").find(":on, :off"), std::string::npos);
  EXPECT_NE(refusal("layer:nerve").find("canal"), std::string::npos);
  EXPECT_NE(refusal("face:101").find("0 to 100"), std::string::npos);
}

TEST(Control, DrillActionOfAPedalIsNoRequest) {
  EXPECT_FALSE(requestOf(haptics::HandAction::drill)) << "it is held";
  for (const auto action :
       {haptics::HandAction::irrigation, haptics::HandAction::undo, haptics::HandAction::tool_change}) {
    const auto request = requestOf(action);
    ASSERT_TRUE(request);
    EXPECT_EQ(request->value, kNoValue) << "next or toggle";
  }
}

TEST(Control, EveryKeyIsInTheHelp) {
  const std::string help = keyHelp();
  for (const ControlMeaning& one : kControls)
    if (!one.key.empty()) {
      EXPECT_NE(help.find("  " + std::string(one.key) + " "), std::string::npos) << one.key;
      EXPECT_NE(help.find(one.does), std::string::npos) << one.does;
    }
  EXPECT_NE(help.find("drill while held"), std::string::npos);
}

}  // namespace
}  // namespace app
