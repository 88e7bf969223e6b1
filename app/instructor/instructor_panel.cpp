#include "app/instructor/instructor_panel.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "app/device/trip_reporter.h"
#include "app/options/bur_name.h"
#include "app/options/picture_option.h"
#include "app/report/markup.h"
#include "app/session/measures/rests_on.h"
#include "app/text/clock_text.h"
#include "app/view/head_up_line.h"
#include "assets/tissue.h"
#include "haptics/contact/law_parameters.h"
#include "render/quality_ladder.h"

namespace app {
namespace {

using Requests = std::vector<ControlRequest>;

constexpr int kPanel_px = 420, kMargin_px = 16, kHeader_px = 52, kStrokes_px = 64;
constexpr int kKeyColumn_px = 280, kKeyRow_px = 17, kMostKeyColumns = 3;
constexpr double kPanoramicShare = 0.3;  ///< of the window's height
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr const char* kBoldFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
constexpr float kText_px = 16.0f, kSmall_px = 13.0f, kLarge_px = 26.0f;

const ImVec4 kInk{0.91f, 0.92f, 0.94f, 1.0f}, kQuiet{0.60f, 0.64f, 0.70f, 1.0f}, kGood{0.42f, 0.80f, 0.55f, 1.0f},
    kWarn{0.98f, 0.73f, 0.28f, 1.0f}, kBad{0.95f, 0.38f, 0.35f, 1.0f}, kStopRed{0.62f, 0.13f, 0.12f, 1.0f},
    kAccent{0.36f, 0.66f, 0.95f, 1.0f};

constexpr const char* kUnconfirmed = ", not confirmed";

// In loading order.
enum FontAt { text_font, small_font, large_font, heading_font };

/// Without the font files all are the built-in font.
ImFont* font(FontAt at) {
  const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
  return fonts[std::min(static_cast<int>(at), fonts.Size - 1)];
}

void textIn(FontAt at, const ImVec4& colour, const std::string& text) {
  ImGui::PushFont(font(at));
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

/// A long line of words, in as many as it needs.
void wrappedIn(FontAt at, const ImVec4& colour, const std::string& text) {
  ImGui::PushFont(font(at));
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void heading(const char* text) {
  ImGui::Dummy({0.0f, 5.0f});
  textIn(heading_font, kAccent, text);
  ImGui::Separator();
}

/// On the line of the previous item.
void alignedRight(FontAt at, const ImVec4& colour, const std::string& text) {
  ImGui::SameLine();
  ImGui::PushFont(font(at));
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::PopFont();
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - width));
  textIn(at, colour, text);
}

/// A name on the left, its value on the right.
void row(const char* name, const std::string& value, const ImVec4& colour = kInk) {
  textIn(text_font, kQuiet, name);
  alignedRight(text_font, colour, value);
}

const ImVec4& grade(double value, double warn_above, double bad_above = std::numeric_limits<double>::infinity()) {
  return value > bad_above ? kBad : value > warn_above ? kWarn : kGood;
}

void bar(double share, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, colour);
  ImGui::ProgressBar(static_cast<float>(std::clamp(share, 0.0, 1.0)), {-1.0f, 6.0f}, "");
  ImGui::PopStyleColor();
}

void drawState(const RehearsalStatus& s) {
  const auto [word, colour] = s.tick.drilling            ? std::pair("Drilling", kWarn)
                              : !s.command.drill_enabled ? std::pair("Drill locked", kQuiet)
                              : s.tick.depth_mm > 0.0    ? std::pair("Touching", kInk)
                                                         : std::pair("Free", kInk);
  textIn(large_font, colour, word);
  alignedRight(large_font, kInk, clockText(s.tick.t_s));
  if (s.recording == RecordingState::running)
    textIn(text_font, kBad, "● recording " + std::filesystem::path(s.recording_path).filename().string());
  else if (s.recording == RecordingState::ended_early)
    textIn(text_font, kWarn, "recording ended early");
  else
    textIn(text_font, kQuiet, "not recorded");
  if (!s.to_instructor.empty()) wrappedIn(text_font, kAccent, s.to_instructor);
  if (!s.said.empty()) wrappedIn(text_font, kInk, s.said);
  if (haptics::has(s.tick.faults, haptics::Fault::bad_pose | haptics::Fault::device | haptics::Fault::bad_force))
    textIn(text_font, kBad, "pose or device fault: the force goes to zero");
}

void drawTool(const RehearsalStatus& s) {
  heading("Tool");
  const double force_N = glm::length(s.tick.commanded_force_P_N.xyz), peak_N = s.command.safety.peak_force_N;
  row("Bur", toolName(s.command.tool));
  row("Irrigation", s.command.irrigating ? "on" : "off", s.command.irrigating ? kInk : kWarn);
  row("Force on the hand", fmt::format("{:.2f} of {:.1f} N", force_N, peak_N), force_N > 0.95 * peak_N ? kWarn : kInk);
  bar(force_N / peak_N, force_N > 0.95 * peak_N ? kWarn : kAccent);
  row("Depth in the surface", fmt::format("{:.2f} mm", s.tick.depth_mm));
  row("Touches", s.tick.depth_mm > 0.0 ? std::string(assets::kTissues[s.tick.contact_tissue].name) : "–");
  if (!s.ruler.empty()) textIn(text_font, kAccent, s.ruler);
  if (!s.way.empty()) wrappedIn(text_font, kAccent, s.way);
  // As in the summary: without what the scan has of the gum in the voxels of the bone's surface.
  double bone_mm3 = 0.0, tooth_mm3 = 0.0;
  for (std::size_t l = 0; l < s.tick.removed_total_mm3.size(); ++l) {
    const auto label = static_cast<std::uint8_t>(l);
    if (assets::isTooth(label))
      tooth_mm3 += s.tick.removed_total_mm3[l];
    else if (assets::isHard(label))
      bone_mm3 += s.tick.removed_total_mm3[l];
  }
  row("Bone removed", fixedText(bone_mm3, 1) + " mm³");
  row("Tooth removed", fixedText(tooth_mm3, 1) + " mm³");
  const std::string dry = s.dry_s >= 1.0 ? ", " + clockText(s.dry_s) + " dry" : "";
  row("Cutting", clockText(s.cutting_s) + dry, dry.empty() ? kInk : kWarn);
}

/// From the tool to what it is to keep off, wherever it is: the surgeon may see it or not.
void drawClearances(const RehearsalStatus& s) {
  if (std::ranges::none_of(s.clearances, [](const auto& mm) { return mm.has_value(); })) return;
  heading("Clearance");
  for (std::size_t n = 0; n < s.clearances.size(); ++n) {
    if (!s.clearances[n]) continue;
    const assets::RiskLevel level = assets::riskLevel(n, *s.clearances[n]);
    const bool is_confirmed = isConfirmed(static_cast<assets::RiskStructure>(n), s.proposed);
    row(std::string(assets::kRiskTexts[n].name).c_str(),
        fixedText(*s.clearances[n], 1) + " mm" + (is_confirmed ? "" : kUnconfirmed),
        !is_confirmed                       ? kQuiet
        : level == assets::RiskLevel::red   ? kBad
        : level == assets::RiskLevel::amber ? kWarn
        : level == assets::RiskLevel::note  ? kGood
                                            : kInk);
  }
}

/// By the library that measures the recording later.
void drawMeasures(const RehearsalStatus& s) {
  if (s.measures.empty()) return;
  heading("Measures so far");
  const auto text_of = [&](std::string_view id, const char* unit, int digits) {
    const auto found = std::ranges::find(s.measures, id, &MeasureValue::id);
    const bool is_told = found != s.measures.end() && found->value;
    return is_told ? fixedText(*found->value, digits) + unit : std::string("–");
  };
  row("Drill on, drilling", text_of("M1.on", "", 0) + " s, " + text_of("M1.drilling", " s", 0));
  row("Dry", text_of("S10.dry", " s", 1));
  row("Removed for each second on", text_of("M3.rate", " mm³", 2));
  row("Painting index", text_of("PI", "", 2));
  row("Way in over way along", text_of("PI.plunge", "", 2));
  for (std::size_t n = 0; n < s.least.size(); ++n) {
    if (!s.least[n]) continue;
    const assets::RiskLevel level = assets::riskLevel(n, s.least[n]->mm);
    const bool is_confirmed = isConfirmed(static_cast<assets::RiskStructure>(n), s.proposed);
    row(("Nearest to " + std::string(assets::kRiskTexts[n].name)).c_str(),
        fixedText(s.least[n]->mm, 1) + " mm at " + clockText(s.least[n]->t_s) + (is_confirmed ? "" : kUnconfirmed),
        !is_confirmed                       ? kQuiet
        : level == assets::RiskLevel::red   ? kBad
        : level == assets::RiskLevel::amber ? kWarn
                                            : kInk);
  }
}

/// "stiffness_N_per_mm" as "stiffness": the unit stands behind the value.
std::string nameWithoutUnit(std::string_view key) {
  std::string name(key.substr(0, key.find("_N")));
  std::ranges::replace(name, '_', ' ');
  return name;
}

void drawLaw(const RehearsalStatus& s, Requests& requests) {
  heading("Force law");
  const haptics::LawName& now = haptics::kLaws[static_cast<std::size_t>(s.command.law.kind)];
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##law", fmt::format("{}     {}", now.key.data(), now.formula.data()).c_str())) {
    for (const haptics::LawName& one : haptics::kLaws) {
      const bool admitted = haptics::supports(one.kind, s.command.tool.head.kind);
      const std::string label = fmt::format("{}     {}", one.key.data(), one.formula.data());
      if (ImGui::Selectable(label.c_str(), one.kind == now.kind, admitted ? 0 : ImGuiSelectableFlags_Disabled))
        requests.push_back({Control::law, static_cast<int>(one.kind)});
    }
    if (ImGui::IsKeyPressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
    ImGui::EndCombo();
  }
  // The many tissues are folded.
  const auto draw_parameters = [&](bool of_tissues) {
    for (const haptics::LawParameter& p : haptics::lawParameters()) {
      if (p.law && *p.law != s.command.law.kind) continue;
      if ((p.unit.empty() && p.key.starts_with("stiffness_")) != of_tissues) continue;
      row(nameWithoutUnit(p.key).c_str(), fmt::format("{:.4g} {}", p.of(s.command.law), p.unit));
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(p.meaning).c_str());
    }
  };
  draw_parameters(false);
  if (ImGui::TreeNode("Stiffness of tissues")) {
    draw_parameters(true);
    ImGui::TreePop();
  }
}

void drawView(const RehearsalStatus& s) {
  heading("View");
  const ImVec4& drawing = grade(s.drawing_ms / s.budget_ms, 1.0);
  row("Display", s.display + fmt::format(", {:.0f} Hz", s.refresh_Hz));
  row("Drawn in", fmt::format("{:.1f} of {:.1f} ms", s.drawing_ms, s.budget_ms), drawing);
  bar(s.drawing_ms / s.budget_ms, drawing);
  row("Frames", fmt::format("{:.0f} a second", s.frames_per_s));
  row("Motion to photon", fmt::format("{:.0f} ms", s.latency.total_ms()));
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "pose to swap %.1f ms, measured\nservo %.1f + blank %.1f + scan-out %.1f ms, added\n"
        "without the device's transport and the panel's response",
        s.latency.pose_to_swap_ms, s.latency.servo_ms, s.latency.blank_ms, s.latency.scan_out_ms);
  row("Quality", s.quality + (s.quality_is_held ? ", held" : ""), s.quality_step > 3 ? kWarn : kInk);
}

void drawServo(const RehearsalStatus& s) {
  heading("Servo");
  const double budget_us = 1e6 / s.servo_rate_Hz;
  const ImVec4& health = grade(s.servo.work_p99_us / budget_us, 0.5, 0.8);
  row("Work, 99 % below", fmt::format("{:.0f} of {:.0f} µs", s.servo.work_p99_us, budget_us), health);
  bar(s.servo.work_p99_us / budget_us, health);
  const double missed_share =
      static_cast<double>(s.servo.missed) / static_cast<double>(std::max<std::uint64_t>(1, s.servo.ticks));
  row("Deadlines missed", fmt::format("{} of {}", s.servo.missed, s.servo.ticks), missed_share > 0.01 ? kWarn : kInk);
  row("Wakes late by", fmt::format("{:.0f} µs, 99 % below {:.0f}", s.servo.late_p50_us, s.servo.late_p99_us));
  row("Real-time priority", s.servo.grants.priority ? "granted" : "not granted",
      s.servo.grants.priority ? kGood : kWarn);
}

void drawCalibration(const RehearsalStatus& s) {
  const std::string& verdict = s.calibration.verdict;
  row("Calibration",
      verdict.empty() ? calibrationText(s.calibration) : fmt::format("{}, {:.2f} mm", verdict, s.calibration.rms_mm),
      verdict == "green"            ? kGood
      : verdict == "red"            ? kBad
      : s.calibration.rig == "none" ? kQuiet
                                    : kWarn);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", calibrationText(s.calibration).c_str());
  // The remark that only names the rig is left out.
  ImGui::PushFont(font(small_font));
  ImGui::PushStyleColor(ImGuiCol_Text, kWarn);
  for (const std::string& remark : s.remarks)
    if (!remark.ends_with(calibrationText(s.calibration))) ImGui::TextWrapped("%s", remark.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void drawHand(const RehearsalStatus& s, Requests& requests) {
  heading("Hand");
  using haptics::SafetyState;
  const SafetyState state = s.tick.state;
  const haptics::StateText& text = haptics::textOf(state);
  row("Device", s.device);
  drawCalibration(s);
  row("State", std::string(text.key),
      state == SafetyState::active                               ? kGood
      : state == SafetyState::fault || state == SafetyState::off ? kBad
                                                                 : kWarn);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\n%s", std::string(text.what).c_str(), std::string(text.next).c_str());
  if (s.tick.hand.motor_heat > 0.0) {
    const double heat = s.tick.hand.motor_heat;
    row("Motors", fmt::format("{:.0f} % of their heat", 100.0 * heat), grade(heat, 0.5, 0.8));
  }
  row("Safety", tripsText(s.trips));
  const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  ImGui::BeginDisabled(!s.has_motors);
  ImGui::PushStyleColor(ImGuiCol_Button, kStopRed);
  if (ImGui::Button("Stop motors", {width, 30.0f})) requests.push_back({Control::stop});
  ImGui::PopStyleColor();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(state != SafetyState::fault);
  if (ImGui::Button("Arm again", {width, 30.0f})) requests.push_back({Control::arm});
  ImGui::EndDisabled();
}

void drawLayers(const RehearsalStatus& s, Requests& requests) {
  heading("Shown");
  for (std::size_t i = 0; i < kPictureLayers.size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine(0.5f * ImGui::GetWindowContentRegionMax().x);
    bool on = s.layers.*kPictureLayers[i].on;
    if (ImGui::Checkbox(kPictureLayers[i].label.data(), &on)) requests.push_back({Control::layer, static_cast<int>(i)});
  }
  ImGui::SetNextItemWidth(-1.0f);
  int face_percent = static_cast<int>(std::lround(100.0f * s.layers.face_opacity));
  if (ImGui::SliderInt("##face", &face_percent, 0, 100, "Face %d %%", ImGuiSliderFlags_AlwaysClamp))
    requests.push_back({Control::face, face_percent});
}

void drawButtons(const RehearsalStatus& s, Requests& requests) {
  ImGui::Dummy({0.0f, 8.0f});
  const float width = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
  const bool locked = !s.command.drill_enabled;
  if (ImGui::Button(locked ? "Unlock drill" : "Lock drill", {width, 34.0f}))
    requests.push_back({Control::drill, locked ? 1 : 0});
  ImGui::SameLine();
  if (ImGui::Button("Snapshot", {width, 34.0f})) requests.push_back({Control::snapshot});
  ImGui::SameLine();
  if (ImGui::Button("End", {width, 34.0f})) requests.push_back({Control::end});
}

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void drawHeader(const RehearsalStatus& s, float width_px) {
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({width_px, static_cast<float>(kHeader_px)});
  ImGui::Begin("##header", nullptr, kFixed | ImGuiWindowFlags_NoBackground);
  const bool is_narrow = width_px < static_cast<float>(kKeyColumn_px);
  wrappedIn(is_narrow ? small_font : heading_font, kInk, s.patient_title);
  if (!is_narrow) {
    ImGui::SameLine();
    textIn(text_font, kQuiet, "   what the surgeon sees");
  }
  ImGui::End();
}

/// As many as fit with their meanings; 0: there is no room for one.
int keyColumns(int width_px) { return std::min(kMostKeyColumns, width_px / kKeyColumn_px); }

int keysHeight_px(int width_px) {
  const int columns = keyColumns(width_px), keys = static_cast<int>(keyMeanings().size());
  return 2 * kMargin_px + kKeyRow_px * (columns == 0 ? 1 : (keys + columns - 1) / columns);
}

void drawKeys(float top_px, int width_px) {
  ImGui::SetNextWindowPos({0.0f, top_px});
  ImGui::SetNextWindowSize({static_cast<float>(width_px), static_cast<float>(keysHeight_px(width_px))});
  ImGui::Begin("##keys", nullptr, kFixed | ImGuiWindowFlags_NoBackground);
  ImGui::PushFont(font(small_font));
  const int columns = keyColumns(width_px);
  if (columns == 0) ImGui::TextColored(kQuiet, "F1 shows the keys");
  if (columns > 0 && ImGui::BeginTable("keys", columns)) {
    for (const KeyMeaning& key : keyMeanings()) {
      ImGui::TableNextColumn();
      ImGui::TextColored(kInk, "%s", key.key.data());
      ImGui::SameLine(96.0f);
      ImGui::TextColored(kQuiet, "%s", key.does.data());
    }
    ImGui::EndTable();
  }
  ImGui::PopFont();
  ImGui::End();
}

/// A click on a stroke brings the bone to its end, one before the first to where all are undone.
void drawStrokes(const RehearsalStatus& s, float top_px, float width_px, Requests& requests) {
  ImGui::SetNextWindowPos({0.0f, top_px});
  ImGui::SetNextWindowSize({width_px, static_cast<float>(kStrokes_px)});
  ImGui::Begin("##strokes", nullptr, kFixed | ImGuiWindowFlags_NoBackground);
  const std::vector<double>& begun_s = s.strokes.begun_s();
  const double now_s = std::max(1e-3, s.tick.t_s + s.tick.dt_s);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, static_cast<float>(kStrokes_px) - 36.0f};
  ImGui::InvisibleButton("strokes", size);
  const auto x_of = [&](double t_s) { return corner.x + static_cast<float>(t_s / now_s) * size.x; };
  const bool is_pointed = ImGui::IsItemHovered(), is_clicked = ImGui::IsItemClicked();
  const double pointed_s = static_cast<double>((ImGui::GetIO().MousePos.x - corner.x) / size.x) * now_s;
  const auto before =
      static_cast<std::size_t>(std::ranges::upper_bound(begun_s, pointed_s + 0.004 * now_s) - begun_s.begin());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(30, 33, 39, 255), 4.0f);
  for (std::size_t n = 0; n < begun_s.size(); ++n) {
    const bool is_done = n < s.strokes.done(), is_last = n + 1 == s.strokes.done();
    const float x = x_of(begun_s[n]), height = is_last ? 0.0f : 4.0f;
    draw.AddRectFilled({x - 1.5f, corner.y + height}, {x + 1.5f, corner.y + size.y - height},
                       is_last   ? IM_COL32(235, 238, 242, 255)
                       : is_done ? IM_COL32(92, 168, 242, 255)
                                 : IM_COL32(92, 98, 110, 255));
  }
  ImGui::PushFont(font(small_font));
  if (is_pointed && !begun_s.empty()) {
    ImGui::SetTooltip("%s", before == s.strokes.done() ? "the bone as it is"
                            : before == 0              ? "before all strokes"
                                          : ("to the stroke of " + clockText(begun_s[before - 1])).c_str());
    draw.AddRect({x_of(before == 0 ? 0.0 : begun_s[before - 1]) - 3.0f, corner.y},
                 {x_of(before == 0 ? 0.0 : begun_s[before - 1]) + 3.0f, corner.y + size.y},
                 IM_COL32(250, 186, 71, 255));
  }
  ImGui::TextColored(kQuiet, "%s",
                     begun_s.empty() ? "Strokes: none yet"
                                     : fmt::format("Strokes: {} done, {} to redo; a click goes there", s.strokes.done(),
                                                   begun_s.size() - s.strokes.done())
                                           .c_str());
  ImGui::PopFont();
  ImGui::End();
  if (is_clicked && !begun_s.empty())
    for (const ControlRequest& request : requestsForStrokes(s.strokes.done(), before)) requests.push_back(request);
}

/// The largest area of a shape in a box, centred at its upper edge.
ImageArea largestIn(glm::ivec2 corner_px, glm::ivec2 box_px, glm::ivec2 shape_px) {
  const glm::dvec2 box = glm::max(box_px, glm::ivec2(1)), shape = glm::max(shape_px, glm::ivec2(1));
  const double scale = std::min(box.x / shape.x, box.y / shape.y);
  const glm::ivec2 size = glm::max(glm::ivec2(scale * shape), glm::ivec2(1));
  return {corner_px + glm::ivec2((static_cast<int>(box.x) - size.x) / 2, 0), size};
}

void stylePanel() {
  ImFontAtlas* const fonts = ImGui::GetIO().Fonts;
  // Latin-1, dashes, three dots, and the dot of a recording.
  static constexpr ImWchar kGlyphs[] = {0x20, 0xff, 0x2013, 0x2014, 0x2026, 0x2026, 0x25cf, 0x25cf, 0};
  if (std::filesystem::exists(kFont) && std::filesystem::exists(kBoldFont)) {
    fonts->AddFontFromFileTTF(kFont, kText_px, nullptr, kGlyphs);
    fonts->AddFontFromFileTTF(kFont, kSmall_px, nullptr, kGlyphs);
    fonts->AddFontFromFileTTF(kBoldFont, kLarge_px, nullptr, kGlyphs);
    fonts->AddFontFromFileTTF(kBoldFont, kText_px, nullptr, kGlyphs);
  } else {
    fonts->AddFontDefault();
  }
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {static_cast<float>(kMargin_px), 12.0f};
  style.ItemSpacing = {8.0f, 5.0f};
  style.FrameRounding = 4.0f;
  style.WindowBorderSize = 0.0f;
  style.Colors[ImGuiCol_WindowBg] = {0.105f, 0.115f, 0.135f, 1.0f};
  style.Colors[ImGuiCol_FrameBg] = {0.17f, 0.185f, 0.215f, 1.0f};
  style.Colors[ImGuiCol_Button] = {0.20f, 0.24f, 0.30f, 1.0f};
  style.Colors[ImGuiCol_Separator] = {0.23f, 0.25f, 0.29f, 1.0f};
  style.Colors[ImGuiCol_CheckMark] = kAccent;
  style.Colors[ImGuiCol_SliderGrab] = kAccent;
}

}  // namespace

PanelContext::PanelContext() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  stylePanel();
}

PanelContext::~PanelContext() { ImGui::DestroyContext(); }

ImageArea imageArea(glm::ivec2 window_px, glm::ivec2 surgeon_px) {
  const glm::ivec2 free = window_px - glm::ivec2(kPanel_px + 2 * kMargin_px,
                                                 kHeader_px + kStrokes_px + keysHeight_px(window_px.x - kPanel_px) +
                                                     static_cast<int>(kPanoramicShare * window_px.y));
  return largestIn({kMargin_px, kHeader_px}, free, surgeon_px);
}

ImageArea panoramicArea(glm::ivec2 window_px, glm::ivec2 surgeon_px, glm::ivec2 panoramic_px) {
  const ImageArea above = imageArea(window_px, surgeon_px);
  const glm::ivec2 corner{kMargin_px,
                          above.corner_px.y + above.size_px.y + kStrokes_px + keysHeight_px(window_px.x - kPanel_px)};
  return largestIn(corner, window_px - corner - glm::ivec2(kPanel_px + kMargin_px, kMargin_px), panoramic_px);
}

std::vector<ControlRequest> drawInstructorPanel(const RehearsalStatus& status, glm::ivec2 window_px,
                                                glm::ivec2 surgeon_px) {
  Requests requests;
  const auto left_px = static_cast<float>(window_px.x - kPanel_px), height_px = static_cast<float>(window_px.y);
  drawHeader(status, left_px);
  const ImageArea area = imageArea(window_px, surgeon_px);
  const int below_px = area.corner_px.y + area.size_px.y + 4;
  drawStrokes(status, static_cast<float>(below_px), left_px, requests);
  drawKeys(static_cast<float>(below_px + kStrokes_px), window_px.x - kPanel_px);
  ImGui::SetNextWindowPos({left_px, 0.0f});
  ImGui::SetNextWindowSize({static_cast<float>(kPanel_px), height_px});
  ImGui::Begin("##panel", nullptr, (kFixed & ~ImGuiWindowFlags_NoScrollbar));
  drawState(status);
  drawButtons(status, requests);
  drawHand(status, requests);
  drawTool(status);
  drawClearances(status);
  drawMeasures(status);
  drawLaw(status, requests);
  drawView(status);
  drawServo(status);
  drawLayers(status, requests);
  ImGui::End();
  return requests;
}

}  // namespace app
