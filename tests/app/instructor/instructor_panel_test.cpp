#include "app/instructor/instructor_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr glm::ivec2 kWindow_px{1360, 1500}, kPicture_px{1280, 800};

std::string withoutBlanks(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (c > ' ') letters += c;
  return letters;
}

/// The panel on ImGui alone: no window, no OpenGL, a mouse that tests move.
class InstructorPanel : public testing::Test {
 protected:
  InstructorPanel() {
    ImGuiIO& io = ImGui::GetIO();
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    io.DisplaySize = {static_cast<float>(kWindow_px.x), static_cast<float>(kWindow_px.y)};
    io.DeltaTime = 0.1f;
    status_.patient_title = "block of bone";
    status_.tick.state = haptics::SafetyState::active;
  }

  std::vector<ControlRequest> draw() {
    ImGui::NewFrame();
    std::vector<ControlRequest> requests = drawInstructorPanel(status_, kWindow_px, kPicture_px);
    list_is_open_ = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    ImGui::Render();
    return requests;
  }

  /// All that is written on it, without blanks: read back from the triangles of its letters.
  std::string text() {
    draw();  // places are known from the second drawing on
    draw();
    std::map<std::pair<float, float>, char> letters;
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
      for (const ImFontGlyph& glyph : font->Glyphs)
        if (glyph.Visible && glyph.Codepoint < 128) letters[{glyph.U0, glyph.V0}] = static_cast<char>(glyph.Codepoint);
    std::string written;
    const ImDrawData* const drawn = ImGui::GetDrawData();
    for (int list = 0; list < drawn->CmdListsCount; ++list)
      for (const ImDrawVert& corner : drawn->CmdLists[list]->VtxBuffer)
        if (const auto letter = letters.find({corner.uv.x, corner.uv.y}); letter != letters.end())
          written += letter->second;
    return written;
  }

  /// Comes, presses, lets go.
  std::vector<ControlRequest> click(ImVec2 at) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    draw();
    std::vector<ControlRequest> requests;
    for (const bool down : {true, false}) {
      io.MouseDown[0] = down;
      for (const ControlRequest& request : draw()) requests.push_back(request);
    }
    return requests;
  }

  using Asked = std::pair<Control, int>;
  static Asked asked(const ControlRequest& request) { return {request.control, request.value}; }
  static Asked asked(const char* written) { return asked(requestFrom(written)); }

  /// Clicks all over the panel; what can be asked for there, and where.
  std::map<Asked, ImVec2> allRequests() {
    std::map<Asked, ImVec2> found;
    const auto left = static_cast<float>(kWindow_px.x - 420);
    for (float y = 6.0f; y < static_cast<float>(kWindow_px.y); y += 9.0f)
      for (const float x : {30.0f, 220.0f, 340.0f}) {
        for (const ControlRequest& request : click({left + x, y})) found.emplace(asked(request), ImVec2{left + x, y});
        if (list_is_open_) list_at_ = ImVec2{left + x, y}, click({4.0f, 1490.0f});
      }
    return found;
  }

  PanelContext context_;
  RehearsalStatus status_;
  ImVec2 list_at_{0.0f, 0.0f};
  bool list_is_open_ = false;
};

TEST_F(InstructorPanel, RequestsEveryControlOfItsOwnAndNoOther) {
  status_.tick.state = haptics::SafetyState::fault;
  const auto found = allRequests();
  for (const char* wanted : {"drill:off", "snapshot", "end", "stop", "arm", "layer:gum", "layer:canal",
                             "layer:clearance", "layer:plan", "layer:ghost", "layer:slices"})
    EXPECT_TRUE(found.contains(asked(wanted))) << wanted;
  for (const auto& [request, at] : found)
    EXPECT_FALSE(
        std::ranges::count(std::array{Control::tool, Control::irrigation, Control::undo, Control::home}, request.first))
        << meaningOf(request.first).name << ": only hand and pedal have them";
  // Laws are in a list that opens below.
  ASSERT_GT(list_at_.y, 0.0f);
  click(list_at_);
  ASSERT_TRUE(list_is_open_);
  std::vector<ControlRequest> chosen;
  for (float below = 20.0f; list_is_open_ && below < 60.0f; below += 8.0f)
    for (const ControlRequest& request : click({list_at_.x, list_at_.y + below})) chosen.push_back(request);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].control, Control::law);
}

TEST_F(InstructorPanel, AClickIsOneRequest) {
  const auto found = allRequests();
  ASSERT_TRUE(found.contains(asked("snapshot")));
  EXPECT_EQ(click(found.at(asked("snapshot"))), (std::vector<ControlRequest>{{Control::snapshot}}));
  EXPECT_TRUE(draw().empty());
}

/// Four strokes at 1, 3, 5 and 7 s of 10, the last one undone.
TEST_F(InstructorPanel, GoesToTheStrokeThatIsClicked) {
  for (std::uint8_t n = 1; n <= 4; ++n) {
    haptics::Tick tick;
    tick.t_s = 2.0 * n - 1.0;
    tick.strokes = n;
    tick.removed_mm3 = 0.1;
    status_.strokes.follow(std::span(&tick, 1));
  }
  haptics::Tick undone;
  undone.strokes = 3, undone.undone_strokes = 1;
  undone.restored_total_mm3 = 0.5;
  status_.strokes.follow(std::span(&undone, 1));
  status_.tick.t_s = 10.0;
  ASSERT_EQ(status_.strokes.done(), 3u);
  // The strip below the picture: its middle, as wide as what is left of the panel without its margins.
  const ImageArea picture = imageArea(kWindow_px, kPicture_px);
  const float y = static_cast<float>(picture.corner_px.y + picture.size_px.y) + 26.0f;
  const auto at = [&](double t_s) {
    return ImVec2{16.0f + static_cast<float>(t_s / 10.0) * static_cast<float>(kWindow_px.x - 420 - 32), y};
  };
  EXPECT_EQ(click(at(1.8)), (std::vector<ControlRequest>(2, {Control::undo})));
  EXPECT_EQ(click(at(0.3)), (std::vector<ControlRequest>(3, {Control::undo})));
  EXPECT_EQ(click(at(8.5)), (std::vector<ControlRequest>{{Control::redo}}));
  EXPECT_TRUE(click(at(5.5)).empty()) << "there it is";
}

TEST_F(InstructorPanel, ArmsAgainOnlyAfterAFault) { EXPECT_FALSE(allRequests().contains(asked("arm"))); }

TEST_F(InstructorPanel, UnlocksALockedDrill) {
  status_.command.drill_enabled = false;
  const auto found = allRequests();
  EXPECT_TRUE(found.contains(asked("drill:on")));
  EXPECT_NE(text().find("Unlockdrill"), std::string::npos);
}

TEST_F(InstructorPanel, FadesTheFaceByDragging) {
  const auto found = allRequests();
  const bool faded =
      std::any_of(found.begin(), found.end(), [](const auto& one) { return one.first.first == Control::face; });
  EXPECT_TRUE(faded);
}

TEST_F(InstructorPanel, ShowsEveryFigure) {
  status_.command.tool.head = {haptics::ShapeKind::sphere, 1.5, 0.0};
  status_.tick.removed_total_mm3[1] = 12.34;
  status_.cutting_s = 75.0;
  status_.dry_s = 8.0;
  status_.command.irrigating = false;
  status_.said = "irrigation off: the bur cuts dry";
  status_.way = "overlying bone holds the mesial half: 29.6 mm³, 51.9 in all; the distal half after it";
  status_.device = "scripted hand";
  status_.display = "mono";
  status_.quality = "third resolution";
  status_.quality_is_held = true;
  status_.tick.t_s = 754.0;
  status_.tick.depth_mm = 0.37;
  status_.tick.contact_tissue = 2;
  status_.tick.commanded_force_P_N = {{0.0, 0.0, 1.23}};
  status_.tick.hand.motor_heat = 0.41;
  status_.command.safety.peak_force_N = 3.3;
  status_.command.law.agus.stiffness_N_per_mm = 0.77;
  status_.servo.work_p99_us = 212.0;
  status_.servo.ticks = 60031;
  status_.servo.missed = 11;
  status_.servo.late_p50_us = 32.0;
  status_.servo.late_p99_us = 66.0;
  status_.drawing_ms = 9.5;
  status_.budget_ms = 16.7;
  status_.frames_per_s = 58.0;
  status_.refresh_Hz = 75.0;
  status_.latency = {14.2, 0.5, 8.3, 8.3};
  status_.calibration.rig = "desk";
  status_.calibration.verdict = "green";
  status_.calibration.rms_mm = 0.42;
  status_.remarks = {"the plan is near the arm's reach"};
  status_.layers.face_opacity = 0.3f;
  status_.recording = RecordingState::running;
  status_.recording_path = "s.molar";
  status_.to_instructor = "trial 3, felt: A";
  const std::string seen = text();
  for (const char* shown : {"block of bone",
                            "Touching",
                            "12:34",
                            "recording s.molar",
                            "trial 3, felt: A",
                            "round 3.0 mm, ISO 030",
                            "Irrigation off",
                            "Bone removed 12.3 mm",
                            "Tooth removed 0.0 mm",
                            "Cutting 1:15, 0:08 dry",
                            "irrigation off: the bur cuts dry",
                            "1.23 of 3.3 N",
                            "0.37 mm",
                            "0.77 N/mm",
                            "9.5 of 16.7 ms",
                            "58 a second",
                            "31 ms",
                            "third resolution, held",
                            "mono, 75 Hz",
                            "212 of 1000",
                            "11 of 60031",
                            "32 ",
                            "below 66",
                            "not granted",
                            "scripted hand",
                            "green, 0.42 mm",
                            "the plan is near",
                            "active",
                            "41 % of their heat",
                            "none",
                            "51.9 in all; the distal half after it",
                            "Face 30 %"})
    EXPECT_NE(seen.find(withoutBlanks(shown)), std::string::npos) << shown << "\n" << seen;
  EXPECT_NE(seen.find(withoutBlanks(assets::kTissues[2].name)), std::string::npos);
}

TEST_F(InstructorPanel, ExplainsTheKeys) {
  const std::string seen = text();
  for (const KeyMeaning& key : keyMeanings())
    EXPECT_NE(seen.find(withoutBlanks(key.does)), std::string::npos) << key.does;
}

TEST(PanelContext, IsDestroyedWithItsOwner) {
  {
    const PanelContext context;
    EXPECT_NE(ImGui::GetCurrentContext(), nullptr);
  }
  EXPECT_EQ(ImGui::GetCurrentContext(), nullptr);
}

}  // namespace
}  // namespace app
