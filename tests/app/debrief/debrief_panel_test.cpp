#include "app/debrief/debrief_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "app/instructor/instructor_panel.h"

namespace app {
namespace {

constexpr glm::ivec2 kWindow_px{1280, 900};

/// The strip on ImGui alone: no window, no OpenGL, a mouse that tests move.
class DebriefPanel : public testing::Test {
 protected:
  DebriefPanel() {
    ImGuiIO& io = ImGui::GetIO();
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    io.DisplaySize = {static_cast<float>(kWindow_px.x), static_cast<float>(kWindow_px.y)};
    io.DeltaTime = 0.1F;
    state_.transport = Transport(100.0);
    state_.runs.push_back({"s.molar", 100.0, {{20.0, MarkKind::error, "cutting dry"}}, {}, 0.0});
  }

  DebriefPanelInput draw() {
    ImGui::NewFrame();
    DebriefPanelInput input = drawDebriefPanel(state_, kWindow_px);
    ImGui::Render();
    return input;
  }
  DebriefPanelInput press(float x_px, float y_px) {
    ImGui::GetIO().MousePos = {x_px, y_px};
    draw();
    ImGui::GetIO().MouseDown[0] = true;
    draw();
    return draw();
  }

  PanelContext context_;
  DebriefPanelState state_;
};

/// The first time line of one or more.
float timeLine_px(std::size_t runs) {
  return static_cast<float>(kWindow_px.y - debriefPanelHeight_px(runs)) + 56.0F + 20.0F;
}

TEST_F(DebriefPanel, GoesWhereTheTimeLineIsPressedAndDragged) {
  const DebriefPanelInput middle = press(0.5F * kWindow_px.x, timeLine_px(1));
  ASSERT_TRUE(middle.go_to_s);
  EXPECT_NEAR(*middle.go_to_s, 50.0, 0.5);
  ImGui::GetIO().MousePos = {static_cast<float>(kWindow_px.x) + 50.0F, 0.0F};
  const DebriefPanelInput beyond = draw();
  ASSERT_TRUE(beyond.go_to_s) << "held, it follows outside";
  EXPECT_EQ(*beyond.go_to_s, 100.0);
  ImGui::GetIO().MouseDown[0] = false;
  EXPECT_FALSE(draw().go_to_s);
}

TEST_F(DebriefPanel, HasATimeLineForEachSession) {
  state_.runs.push_back({"t.molar", 60.0, {}, {}, 0.0});
  EXPECT_GT(debriefPanelHeight_px(2), debriefPanelHeight_px(1));
  const DebriefPanelInput second = press(0.5F * kWindow_px.x, timeLine_px(2) + 58.0F);
  ASSERT_TRUE(second.go_to_s);
  EXPECT_NEAR(*second.go_to_s, 50.0, 0.5) << "one time for both";
}

TEST_F(DebriefPanel, PlaysNothingBeforeTheSessionWasRunAgain) {
  state_.prepared_share = 0.4;
  EXPECT_FALSE(press(0.5F * kWindow_px.x, timeLine_px(1)).go_to_s);
}

TEST_F(DebriefPanel, ChangesALayer) {
  const float y_px = static_cast<float>(kWindow_px.y - debriefPanelHeight_px(1)) + 56.0F + 58.0F + 12.0F;
  ImGui::GetIO().MousePos = {26.0F, y_px};
  draw();
  ImGui::GetIO().MouseDown[0] = true;
  draw();
  ImGui::GetIO().MouseDown[0] = false;
  const DebriefPanelInput input = draw();
  ASSERT_TRUE(input.choice);
  EXPECT_FALSE(input.choice->layers.gingiva);
}

}  // namespace
}  // namespace app
