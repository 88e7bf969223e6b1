#include "app/debrief/debrief_panel.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/debrief/debrief_keys.h"
#include "app/options/picture_option.h"
#include "app/text/clock_text.h"

namespace app {
namespace {

constexpr int kStripTop_px = 56, kTimeLine_px = 58, kStripBottom_px = 60;
constexpr float kMargin_px = 16.0F, kFlags_px = 16.0F, kButton_px = 34.0F;
constexpr ImGuiWindowFlags kStrip = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

const ImVec4 kInkColour{0.91F, 0.92F, 0.94F, 1.0F}, kQuietColour{0.60F, 0.64F, 0.70F, 1.0F},
    kSaidColour{0.98F, 0.85F, 0.45F, 1.0F};

// In the loading order of PanelContext.
enum DebriefFont { plain_letters, small_letters, large_letters, bold_letters };

void pushFont(DebriefFont at) {
  const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
  ImGui::PushFont(fonts[std::min(static_cast<int>(at), fonts.Size - 1)]);
}

void write(DebriefFont at, const ImVec4& colour, const std::string& text) {
  pushFont(at);
  ImGui::TextColored(colour, "%s", text.c_str());
  ImGui::PopFont();
}

/// By MarkKind.
constexpr std::array<ImU32, kMarkNames.size()> kMarkColours{IM_COL32(92, 168, 242, 255),  IM_COL32(242, 97, 89, 255),
                                                            IM_COL32(250, 186, 71, 255),  IM_COL32(235, 120, 60, 255),
                                                            IM_COL32(170, 178, 190, 255), IM_COL32(186, 140, 235, 255),
                                                            IM_COL32(120, 200, 200, 255), IM_COL32(107, 204, 140, 255)};
ImU32 colourOf(MarkKind kind) { return kMarkColours[static_cast<std::size_t>(kind)]; }

/// "3:07.4".
std::string preciseClock(double t_s) {
  const double tenths = std::floor(10.0 * std::max(0.0, t_s) + 1e-6);
  const double minutes = std::floor(tenths / 600.0);
  return fmt::format("{:.0f}:{:04.1f}", minutes, (tenths - 600.0 * minutes) / 10.0);
}

void drawForce(ImDrawList& draw, const DebriefPanelRun& run, ImVec2 corner, ImVec2 size, double length_s) {
  if (run.samples.empty() || !(run.most_force_N > 0.0)) return;
  const int columns = std::max(1, static_cast<int>(size.x));
  std::size_t next = 0;
  for (int x = 0; x < columns; ++x) {
    const auto until_s = static_cast<float>((x + 1) * length_s / columns);
    float most_N = 0.0F;
    bool drills = false;
    for (; next < run.samples.size() && run.samples[next].t_s < until_s; ++next) {
      most_N = std::max(most_N, run.samples[next].force_N);
      drills = drills || run.samples[next].drilling;
    }
    const float high = (size.y - kFlags_px) * std::min(1.0F, most_N / static_cast<float>(run.most_force_N));
    if (high < 0.5F) continue;
    const float left = corner.x + static_cast<float>(x), bottom = corner.y + size.y;
    draw.AddRectFilled({left, bottom - high}, {left + 1.0F, bottom},
                       drills ? IM_COL32(118, 140, 172, 255) : IM_COL32(70, 80, 96, 255));
  }
}

void drawMarks(ImDrawList& draw, const DebriefPanelRun& run, ImVec2 corner, ImVec2 size, double length_s) {
  const auto x_of = [&](double t_s) { return corner.x + static_cast<float>(t_s / length_s) * size.x; };
  // What matters most is drawn last.
  constexpr std::array kOrder{MarkKind::tool,  MarkKind::event, MarkKind::undo,  MarkKind::step,
                              MarkKind::coach, MarkKind::touch, MarkKind::error, MarkKind::bookmark};
  for (const MarkKind kind : kOrder)
    for (const SessionMark& mark : run.marks) {
      if (mark.kind != kind) continue;
      const float x = x_of(mark.t_s);
      const bool is_tall = kind == MarkKind::error || kind == MarkKind::bookmark || kind == MarkKind::step;
      draw.AddRectFilled({x - 1.0F, corner.y + 2.0F}, {x + 1.0F, corner.y + (is_tall ? size.y : kFlags_px - 2.0F)},
                         colourOf(kind) & (is_tall ? IM_COL32(255, 255, 255, 190) : IM_COL32_WHITE));
      draw.AddTriangleFilled({x, corner.y + 2.0F}, {x + 7.0F, corner.y + 5.5F}, {x, corner.y + 9.0F}, colourOf(kind));
    }
}

/// The marks under the pointer.
void tellMarks(const DebriefPanelRun& run, double t_s, double within_s) {
  constexpr int kMostTold = 8;
  int told = 0;
  ImGui::BeginTooltip();
  write(bold_letters, kInkColour, preciseClock(t_s));
  for (const SessionMark& mark : run.marks) {
    if (std::abs(mark.t_s - t_s) > within_s || told++ >= kMostTold) continue;
    pushFont(plain_letters);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colourOf(mark.kind)), "%s",
                       std::string(kMarkNames[static_cast<std::size_t>(mark.kind)]).c_str());
    ImGui::SameLine();
    ImGui::TextUnformatted(mark.what.c_str());
    ImGui::PopFont();
  }
  ImGui::EndTooltip();
}

void drawTimeLine(const DebriefPanelState& state, std::size_t number, DebriefPanelInput& input) {
  constexpr float kNear_px = 5.0F;
  const DebriefPanelRun& run = state.runs[number];
  const double length_s = std::max(1e-3, state.transport.length_s());
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, static_cast<float>(kTimeLine_px) - 8.0F};
  ImGui::InvisibleButton(fmt::format("time line {}", number).c_str(), size);
  const double pointed_s =
      std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - corner.x) / size.x), 0.0, 1.0) * length_s;
  if (ImGui::IsItemActive() && state.prepared_share >= 1.0) input.go_to_s = pointed_s;

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + size.x, corner.y + size.y};
  draw.AddRectFilled(corner, end, IM_COL32(30, 33, 39, 255), 4.0F);
  const auto x_of = [&](double t_s) { return corner.x + static_cast<float>(t_s / length_s) * size.x; };
  const double minute_s = length_s > 300.0 ? 60.0 : length_s > 60.0 ? 10.0 : 5.0;
  for (double t_s = minute_s; t_s < length_s; t_s += minute_s)
    draw.AddLine({x_of(t_s), corner.y}, {x_of(t_s), end.y}, IM_COL32(52, 57, 66, 255));
  if (state.clip_from_s || state.clip_to_s)
    draw.AddRectFilled({x_of(state.clip_from_s.value_or(0.0)), corner.y},
                       {x_of(state.clip_to_s.value_or(length_s)), end.y}, IM_COL32(107, 204, 140, 40));
  drawForce(draw, run, corner, size, length_s);
  drawMarks(draw, run, corner, size, length_s);
  if (run.length_s < length_s - 0.05)
    draw.AddRectFilled({x_of(run.length_s), corner.y}, end, IM_COL32(15, 16, 19, 200));
  if (state.runs.size() > 1)
    draw.AddText({corner.x + 6.0F, end.y - 20.0F}, IM_COL32(200, 204, 210, 170), run.name.c_str());
  const float now_x = x_of(state.transport.position_s());
  draw.AddRectFilled({now_x - 1.0F, corner.y - 3.0F}, {now_x + 1.0F, end.y + 3.0F}, IM_COL32(255, 255, 255, 255));
  draw.AddTriangleFilled({now_x - 6.0F, corner.y - 7.0F}, {now_x + 6.0F, corner.y - 7.0F}, {now_x, corner.y + 1.0F},
                         IM_COL32(255, 255, 255, 255));
  if (ImGui::IsItemHovered() && state.prepared_share >= 1.0)
    tellMarks(run, pointed_s, static_cast<double>(kNear_px / size.x) * length_s);
}

/// The newest mark of the first run: what is going on.
std::string nowText(const DebriefPanelState& state) {
  constexpr double kTold_s = 4.0;
  std::string step, newest;
  for (const SessionMark& mark : state.runs.front().marks) {
    if (mark.t_s > state.transport.position_s() + 1e-3) break;
    if (mark.kind == MarkKind::step)
      step = mark.what;
    else if (state.transport.position_s() - mark.t_s < kTold_s)
      newest = fmt::format("{}: {}", kMarkNames[static_cast<std::size_t>(mark.kind)], mark.what);
  }
  return step.empty() || newest.empty() ? step + newest : step + "   " + newest;
}

void drawTop(const DebriefPanelState& state, DebriefPanelInput& input) {
  const Transport& transport = state.transport;
  if (state.prepared_share < 1.0) {
    write(large_letters, kInkColour, "Running the session again");
    ImGui::SameLine();
    ImGui::SetCursorPosY(18.0F);
    const auto text = fmt::format("{:.0f} %", 100.0 * state.prepared_share);
    ImGui::ProgressBar(static_cast<float>(state.prepared_share), {-1.0F, 20.0F}, text.c_str());
    return;
  }
  if (ImGui::Button(transport.isPlaying() ? "Pause" : "Play", {72.0F, kButton_px})) input.plays = true;
  ImGui::SameLine();
  pushFont(large_letters);
  ImGui::TextColored(kInkColour, "%s", preciseClock(transport.position_s()).c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  ImGui::SetCursorPosY(20.0F);
  write(plain_letters, kQuietColour,
        fmt::format("of {}   {}{}", preciseClock(transport.length_s()), transport.speedText(),
                    transport.isBackwards() ? " back" : ""));
  ImGui::SameLine(330.0F);
  if (state.note)
    write(bold_letters, kSaidColour, "Bookmark, Enter keeps it, Esc does not: " + *state.note + "_");
  else if (!state.said.empty())
    write(plain_letters, kSaidColour, state.said);
  else
    write(plain_letters, kInkColour, nowText(state));
}

/// "Sharp edges 17 mm", of two sessions "17, 9 mm"; a dash: no piece is out.
std::string edgesText(const DebriefPanelState& state) {
  std::string lengths;
  for (const DebriefPanelRun& run : state.runs)
    lengths += (lengths.empty() ? "" : ", ") + (run.edges_mm ? fmt::format("{:.0f}", *run.edges_mm) : "-");
  return "   Sharp edges " + lengths + " mm";
}

void drawChoices(const DebriefPanelState& state, DebriefPanelInput& input) {
  PictureChoice choice = state.choice;
  bool changed = false;
  for (const PictureLayer& layer : kPictureLayers) {
    changed = ImGui::Checkbox(layer.label.data(), &(choice.layers.*layer.on)) || changed;
    ImGui::SameLine();
  }
  changed = ImGui::Checkbox("Sharp edges", &choice.edges) || changed;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(110.0F);
  int percent = static_cast<int>(std::lround(100.0F * choice.layers.face_opacity));
  if (ImGui::SliderInt("##face", &percent, 0, 100, "Face %d %%", ImGuiSliderFlags_AlwaysClamp)) {
    choice.layers.face_opacity = static_cast<float>(percent) / 100.0F;
    changed = true;
  }
  if (changed) input.choice = choice;

  constexpr std::array kTrails{"none", "by force: 1, 2, 4 N", "by clearance: its bands"};
  write(small_letters, kQuietColour,
        fmt::format("Way of the tool (T): {}", kTrails[static_cast<std::size_t>(choice.trail)]));
  if (choice.trail != TrailColour::none)
    for (const ImU32 colour : {IM_COL32(72, 196, 112, 255), IM_COL32(226, 206, 62, 255), IM_COL32(238, 142, 40, 255),
                               IM_COL32(220, 40, 40, 255)}) {
      ImGui::SameLine();
      const ImVec2 at = ImGui::GetCursorScreenPos();
      ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 5.0F, at.y + 8.0F}, 5.0F, colour);
      ImGui::Dummy({10.0F, 14.0F});
    }
  for (std::size_t kind = 0; kind < kMarkNames.size(); ++kind) {
    ImGui::SameLine(kind == 0 ? 330.0F : 0.0F);
    write(small_letters, ImGui::ColorConvertU32ToFloat4(kMarkColours[kind]), std::string(kMarkNames[kind]));
  }
  ImGui::SameLine();
  write(small_letters, kQuietColour, "   Space plays, F1: all keys");
  if (!state.choice.edges) return;
  ImGui::SameLine();
  write(small_letters, kInkColour, edgesText(state));
}

void drawSheetOfKeys(glm::ivec2 window_px) {
  ImGui::SetNextWindowPos({0.5F * static_cast<float>(window_px.x), 0.42F * static_cast<float>(window_px.y)},
                          ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::Begin("##keys", nullptr, kStrip | ImGuiWindowFlags_AlwaysAutoResize);
  for (const DebriefKey& one : kDebriefKeys) {
    if (one.name.empty()) continue;
    write(bold_letters, kInkColour, std::string(one.name));
    ImGui::SameLine(170.0F);
    write(plain_letters, kQuietColour, std::string(one.does));
  }
  write(bold_letters, kInkColour, "Right button");
  ImGui::SameLine(170.0F);
  write(plain_letters, kQuietColour, "held: turn the patient");
  ImGui::End();
}

void drawHeader(const DebriefPanelState& state, glm::ivec2 window_px) {
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize({static_cast<float>(window_px.x), static_cast<float>(kDebriefHeader_px)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(kMargin_px, 8.0F));
  ImGui::Begin("##header", nullptr, kStrip);
  const float each = static_cast<float>(window_px.x) / static_cast<float>(state.runs.size());
  for (std::size_t n = 0; n < state.runs.size(); ++n) {
    if (n > 0) ImGui::SameLine(static_cast<float>(n) * each + kMargin_px);
    write(bold_letters, kInkColour, state.runs[n].name);
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace

int debriefPanelHeight_px(std::size_t runs) {
  return kStripTop_px + kStripBottom_px + static_cast<int>(runs) * kTimeLine_px;
}

DebriefPanelInput drawDebriefPanel(const DebriefPanelState& state, glm::ivec2 window_px) {
  DebriefPanelInput input;
  drawHeader(state, window_px);
  const int height_px = debriefPanelHeight_px(state.runs.size());
  ImGui::SetNextWindowPos({0.0F, static_cast<float>(window_px.y - height_px)});
  ImGui::SetNextWindowSize({static_cast<float>(window_px.x), static_cast<float>(height_px)});
  ImGui::Begin("##strip", nullptr, kStrip);
  drawTop(state, input);
  ImGui::SetCursorPosY(static_cast<float>(kStripTop_px));
  for (std::size_t n = 0; n < state.runs.size(); ++n) {
    ImGui::SetCursorPosY(static_cast<float>(kStripTop_px + static_cast<int>(n) * kTimeLine_px));
    drawTimeLine(state, n, input);
  }
  ImGui::SetCursorPosY(static_cast<float>(kStripTop_px + static_cast<int>(state.runs.size()) * kTimeLine_px));
  drawChoices(state, input);
  ImGui::End();
  if (state.keys_shown) drawSheetOfKeys(window_px);
  return input;
}

}  // namespace app
