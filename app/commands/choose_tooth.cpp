#include "app/commands/choose_tooth.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <thread>
#include <variant>

#include <fmt/core.h>

#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/case/pointed_tooth.h"
#include "app/case/root_canals.h"
#include "app/commands/rehearsed_case.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/desk_view.h"
#include "app/view/head_up_line.h"
#include "app/view/patient_renderer.h"
#include "app/view/preparation.h"
#include "app/view/surgeon_display.h"
#include "assets/patient/patient_folder.h"
#include "assets/tooth.h"
#include "haptics/servo/command.h"
#include "render/display/eye_projection.h"

namespace app {
namespace {

using render::MouseButton;

constexpr double kChoiceLoupes = 4.5;
constexpr std::chrono::milliseconds kLookAgain{15};
/// From above and in front: the occlusal surfaces of lower teeth.
const glm::dvec3 kFromAbove_P = glm::normalize(glm::dvec3(0.0, -0.55, 0.84));

/// Of a canal: "mesiobuccal 20.4 mm, 24°".
std::string cardOf(const assets::ToothCanal& canal) {
  return fmt::format("{} {:.1f} mm, {:.0f}°", canal.name, canal.workingLength_mm(),
                     canal.schneider_rad * 180.0 / std::numbers::pi);
}

class ToothChoice {
 public:
  ToothChoice(const RehearseOptions& options, const assets::Patient& patient, std::vector<CanalTooth> teeth,
              std::unique_ptr<DisplayWindows> windows, const calibration::Rig& rig)
      : patient_(patient),
        teeth_(std::move(teeth)),
        display_(
            {.windows = {.screen_px = rig.screen.px, .monitor = options.plan.monitor},
             .backend = options.picture.backend()},
            [&](render::Backend backend) {
              return patientRenderer(patient_, haptics::Command().tool, std::nullopt, patient_.ct.solid,
                                     {.backend = backend});
            },
            printMessage, std::move(windows)),
        view_(rig, {}) {
    frame_.rig = rig;
    frame_.tool_visible = false;
    frame_.layers.face_opacity = 0.0f;
    frame_.layers.gap_ring = false;
    frame_.site_P = rig.X_WP.inverse() * calibration::Point<calibration::World>{};
  }

  std::optional<int> run() {
    for (;;) {
      for (const render::WindowEvent& event : display_.takeEvents()) {
        if (isLeft(event)) return {};
        take(event);
        if (isTaken(event)) return pointed_->fdi;
      }
      point();
      if (!std::exchange(changed_, false)) {
        std::this_thread::sleep_for(kLookAgain);
        continue;
      }
      draw();
    }
  }

 private:
  static bool isLeft(const render::WindowEvent& event) {
    const auto* const key = std::get_if<render::KeyPressed>(&event);
    return std::holds_alternative<render::CloseRequested>(event) ||
           (key && key->down && key->key == render::Key::escape);
  }

  bool isTaken(const render::WindowEvent& event) const {
    const auto* const pressed = std::get_if<render::ButtonPressed>(&event);
    const auto* const key = std::get_if<render::KeyPressed>(&event);
    const bool confirms = (pressed && pressed->down && pressed->button == MouseButton::left) ||
                          (key && key->down && key->key == render::Key::enter);
    return confirms && canBeTreated();
  }

  bool canBeTreated() const { return pointed_ != nullptr && pointed_->canals && pointed_->remark.empty(); }

  void take(const render::WindowEvent& event) {
    if (const auto* const moved = std::get_if<render::PointerMoved>(&event)) {
      pointer_px_ = moved->to_px;
      if (moved->button == MouseButton::right) view_.turn(moved->by_px), changed_ = true;
    }
    if (const auto* const wheel = std::get_if<render::WheelTurned>(&event))
      view_.magnify(wheel->notches > 0.0 ? 1 : -1), changed_ = true;
    const glm::ivec2 px = frame_.rig.screen.px;
    frame_.rig = view_.rig();
    frame_.rig.screen.px = px;
  }

  /// The tooth under the pointer.
  void point() {
    if (!pointer_px_) return;
    const calibration::ScreenCorners& screen = frame_.rig.screen;
    const glm::dvec2 share = *pointer_px_ / glm::dvec2(glm::max(display_.window()->framebufferSize_px(), 1));
    const glm::dvec3 on_screen_W = screen.upper_left.mm + share.x * (screen.lower_right.mm - screen.lower_left.mm) +
                                   share.y * (screen.lower_left.mm - screen.upper_left.mm);
    const auto X_PW = frame_.rig.X_WP.inverse();
    const glm::dvec3 eye_P = (X_PW * render::eyeView(frame_.rig, render::Eye::cyclopean).eye_W).mm;
    const glm::dvec3 at_P = (X_PW * calibration::Point<calibration::World>{on_screen_W}).mm;
    const std::optional<int> fdi = pointedTooth(patient_.ct, eye_P, at_P - eye_P);
    const auto found = std::ranges::find_if(teeth_, [&](const CanalTooth& tooth) { return tooth.fdi == fdi; });
    const CanalTooth* const now = found == teeth_.end() ? nullptr : &*found;
    if (now == pointed_) return;
    pointed_ = now;
    changed_ = true;
    frame_.obstacles = {};
    if (now != nullptr)
      frame_.obstacles = {2.0 * patient_.ct.grid.spacing_mm, markedVoxels_P_mm(patient_.ct, now->fdi)};
  }

  void draw() {
    HeadUpContent words;
    words.line_shown = false;
    words.task = "Root canal treatment: point at a tooth, a click takes it";
    words.way = "right drag turns, the wheel comes nearer, Esc leaves";
    if (pointed_ != nullptr) {
      words.task = fmt::format("{} {}", pointed_->fdi, assets::toothName(pointed_->fdi));
      words.site.clear();
      if (canBeTreated())
        for (const assets::ToothCanal& canal : pointed_->canals->canals)
          words.site += (words.site.empty() ? "" : " · ") + cardOf(canal);
      else
        words.site = pointed_->remark;
      words.way = canBeTreated() ? "a click takes it" : "cannot be treated here";
      if (canBeTreated() && pointed_->canals->is_modelled) words.way += ", its canals are modelled";
    }
    if (line_.update(words, headUpPlace(frame_.rig, display_.mode(), frame_)) || !is_drawn_)
      display_.renderer().setOverlay(line_.panels());
    is_drawn_ = true;
    display_.show(frame_);
  }

  const assets::Patient& patient_;
  std::vector<CanalTooth> teeth_;
  SurgeonDisplay display_;
  DeskView view_;
  render::Frame frame_;
  HeadUpLine line_;
  std::optional<glm::dvec2> pointer_px_;
  const CanalTooth* pointed_ = nullptr;
  bool changed_ = true, is_drawn_ = false;
};

struct LoadedJaw {
  assets::Patient patient;
  std::vector<CanalTooth> teeth;
};

}  // namespace

std::optional<int> chooseTooth(const RehearseOptions& options) {
  const assets::JawParameters jaw = jawOf(options);
  calibration::Rig rig =
      calibration::desktopRig(glm::ivec2(1280, 800), calibration::kDeskMonitorWidth_mm / kChoiceLoupes);
  Preparation preparation({.windows = {.screen_px = rig.screen.px, .monitor = options.plan.monitor}}, rig,
                          "Preparing the jaw", printMessage);
  const auto loaded = preparation.run<LoadedJaw>([&](const assets::ReportProgress& report) {
    LoadedJaw one;
    one.patient = options.patient.empty() ? builtInPatient(jaw, report) : assets::loadPatient(options.patient, report);
    one.teeth = options.patient.empty() ? canalTeeth(jaw) : canalTeeth(one.patient.ct);
    return one;
  });
  if (!loaded) return {};
  glm::dvec3 middle_P(0.0);
  double teeth = 0.0;
  for (const CanalTooth& tooth : loaded->teeth)
    if (tooth.canals) middle_P += tooth.canals->frame.cervix_P_mm, teeth += 1.0;
  if (teeth == 0.0)
    throw UsageError("--task root-canal: this patient has no tooth whose canals could be treated, see molar teeth");
  rig.X_WP = placePatient({middle_P / teeth}, {kFromAbove_P}, {glm::dvec3(0.0, 1.0, 0.0)});
  return ToothChoice(options, loaded->patient, loaded->teeth, preparation.takeWindows(), rig).run();
}

}  // namespace app
