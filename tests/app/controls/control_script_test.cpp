#include "app/controls/control_script.h"

#include <gtest/gtest.h>

#include "app/options/tool_text.h"
#include "app/text/usage_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

std::vector<haptics::Tool> tray() {
  std::vector<haptics::Tool> tools;
  for (const char* text : {"sphere:1.5", "cylinder:0.6,5", "sphere:1"}) {
    const haptics::BurShape head = headFrom(text);
    tools.push_back({head, haptics::standardShaft(head)});
  }
  return tools;
}

TimedRequest row(double t_s, const std::string& tool, const std::string& action) {
  return {t_s, tool, action, "pose file a.csv line 7"};
}

/// Requests due, without their rows.
std::vector<ControlRequest> due(ControlScript& script, std::uint64_t next_tick) {
  std::vector<ControlRequest> requests;
  for (const ScriptedRequest& one : script.takeDue(next_tick)) {
    EXPECT_EQ(one.where, "pose file a.csv line 7");
    requests.push_back(one.request);
  }
  return requests;
}

std::string refusal(const TimedRequest& asked) {
  return tests::refusalOf<UsageError>([&] { ControlScript({asked}, tray(), 1000.0); });
}

TEST(ControlScript, RequestsAtTheFirstTickNotBeforeTheRow) {
  ControlScript script(
      {row(0.0, "", "irrigation:off"), row(0.1, "", "undo"), row(0.1004, "", "arm"), row(0.3, "", "end")}, tray(),
      1000.0);
  EXPECT_EQ(due(script, 0), std::vector<ControlRequest>({{Control::irrigation, 0}}));
  EXPECT_EQ(script.nextTick(), 100u);
  EXPECT_TRUE(due(script, 99).empty());
  EXPECT_EQ(due(script, 100), std::vector<ControlRequest>({{Control::undo}}));
  EXPECT_EQ(script.nextTick(), 101u);
  // A loop that looks late gets all that was due, once.
  EXPECT_EQ(due(script, 500), std::vector<ControlRequest>({{Control::arm}, {Control::end}}));
  EXPECT_FALSE(script.nextTick());
  EXPECT_TRUE(due(script, 900).empty());
}

TEST(ControlScript, HitsTheTickOfEveryMillisecond) {
  std::vector<TimedRequest> rows;
  for (int ms = 0; ms < 5000; ++ms) rows.push_back(row(std::stod(std::to_string(ms) + "e-3"), "", "snapshot"));
  ControlScript script(rows, tray(), 1000.0);
  for (std::uint64_t ms = 0; ms < 5000; ++ms) ASSERT_EQ(due(script, ms).size(), 1u) << ms;
}

TEST(ControlScript, SelectsAToolByNumberOrTextOnce) {
  ControlScript script({row(0.0, "2", ""), row(0.001, "2", ""), row(0.002, "sphere:1", ""), row(0.003, "1", "undo")},
                       tray(), 1000.0);
  EXPECT_EQ(due(script, 0), std::vector<ControlRequest>({{Control::tool, 1}}));
  EXPECT_TRUE(due(script, 1).empty());
  EXPECT_EQ(due(script, 2), std::vector<ControlRequest>({{Control::tool, 2}}));
  EXPECT_EQ(due(script, 3), std::vector<ControlRequest>({{Control::tool, 0}, {Control::undo}}));
}

TEST(ControlScript, SkipsAToolThatIsInTheHand) {
  const std::vector<haptics::Tool> one_tool{tray().front()};
  ControlScript names_it_twice({row(0.0, "1", ""), row(0.1, "sphere:1.5", "")}, one_tool, 1000.0);
  EXPECT_FALSE(names_it_twice.nextTick());
  // One tool written in two ways, and after an action that changes it.
  ControlScript script({row(0.0, "2", ""), row(0.1, "cylinder:0.6,5", ""), row(0.2, "", "tool"), row(0.3, "3", ""),
                        row(0.4, "", "tool:1"), row(0.5, "3", "")},
                       tray(), 1000.0);
  EXPECT_EQ(due(script, 1000),
            std::vector<ControlRequest>({{Control::tool, 1}, {Control::tool}, {Control::tool, 0}, {Control::tool, 2}}));
}

TEST(ControlScript, NamesTheRowOfAnInvalidRequest) {
  for (const TimedRequest& asked :
       {row(0, "4", ""), row(0, "0", ""), row(0, "sphere:2", ""), row(0, "spoon", ""), row(0, "", "jump"),
        row(0, "", "tool:two"), row(0, "", "tool:4"), row(0, "", "face:300")})
    EXPECT_EQ(refusal(asked).find("pose file a.csv line 7: "), 0u) << refusal(asked);
  EXPECT_NE(refusal(row(0, "4", "")).find("the tray holds 3"), std::string::npos);
}

}  // namespace
}  // namespace app
