#include "app/rehearsal.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <span>

#include "app/brick_upload.h"
#include "app/hand_input.h"
#include "app/rehearsal_summary.h"
#include "app/snapshot.h"
#include "app/trough_plan.h"
#include "app/usage_error.h"
#include "assets/instrument.h"
#include "calibration/geometry/units.h"
#include "haptics/device/mouse_device.h"
#include "haptics/device/scripted_hand.h"
#include "render/display/window.h"
#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"

namespace app {
namespace {

using calibration::Patient;
using calibration::Point;
using calibration::Pose;
using calibration::Tool;
using calibration::World;
using Clock = std::chrono::steady_clock;

constexpr double kBurTurnsPerSecond = 7.0;  ///< as drawn: a real bur turns too fast for any display to show
constexpr int kSnapshotSamples = 2;

volatile std::sig_atomic_t interrupted = 0;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// From the bur to the handle, W: towards the viewer and down over the lower lip, so that it does not hide the site.
glm::dvec3 shaftDirection_W() { return glm::normalize(glm::dvec3(0.12, -0.38, 0.92)); }

/// Where the mouse's tool begins: in front of the site.
Pose<World, Tool> restingTool() { return {glm::dquat(glm::dvec3(0, 0, 1), shaftDirection_W()), {0.0, 6.0, 12.0}}; }

/// The hand of this rehearsal, and how its frame stands to the patient.
struct HandAtWork {
  std::unique_ptr<haptics::HapticDevice> device;
  haptics::MouseDevice* mouse = nullptr;  ///< set where the window moves the hand
  Pose<Patient, calibration::Device> X_PD;
  std::optional<double> duration_s;
};

HandAtWork handOf(const RehearsalPlan& plan) {
  HandAtWork hand;
  if (plan.hand == Hand::scripted) {
    auto trough = planBuccalTrough(plan.patient, plan.command.bur_radius_mm);
    if (!trough)
      throw UsageError("--device scripted: this patient has no third molar with bone beside it, use --device mouse");
    trough->shaft_D = {glm::conjugate(plan.rig.X_WP.rotation) * shaftDirection_W()};
    auto scripted = std::make_unique<haptics::ScriptedHand>(*trough);
    hand.duration_s = scripted->duration_s();
    hand.device = std::move(scripted);
    return hand;
  }
  // The mouse moves in W.
  const Pose<World, Tool> X_WT = restingTool();
  auto mouse =
      std::make_unique<haptics::MouseDevice>(haptics::MouseTarget{{X_WT.rotation, X_WT.translation_mm}, false});
  hand.mouse = mouse.get();
  hand.device = std::move(mouse);
  const Pose<World, Patient> X_WP = plan.rig.X_WP;
  hand.X_PD = {X_WP.inverse().rotation, X_WP.inverse().translation_mm};
  return hand;
}

double mmPerPx(const calibration::ScreenCorners& screen) {
  return glm::distance(screen.lower_left.mm, screen.lower_right.mm) / screen.px.x;
}

/// One rehearsal from the first frame on.
class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        hand_(handOf(plan_)),
        duration_s_(plan_.seconds ? plan_.seconds : hand_.duration_s),
        input_(restingTool(), mmPerPx(plan_.rig.screen)) {
    openDisplay();
    renderer_ = rendererWith(1, plan_.patient.ct.solid);
    frame_.rig = plan_.rig;
    frame_.display = plan_.display;
    frame_.bur_radius_mm = plan_.command.bur_radius_mm;
    frame_.face_window_mm = plan_.face_window_mm;
    frame_.site_P = {plan_.patient.site.third_molar_P_mm};
    frame_.tool_visible = false;
    workstation_.emplace(plan_.patient, std::move(hand_.device),
                         haptics::ServoSettings{plan_.rate_Hz, hand_.X_PD, {}, true}, plan_.command, plan_.recording);
  }

  void run() {
    drawFrame();
    first_picture_s_ = secondsSince(plan_.begun);
    if (!plan_.first_snapshot.empty()) takeSnapshot(plan_.first_snapshot, plan_.patient.ct.solid);
    workstation_->start();
    looping_since_ = Clock::now();
    while (!isOver()) {
      takeInput();
      followServo();
      drawFrame();
      showStatus();
    }
    loop_s_ = secondsSince(looping_since_);
    finish();
  }

 private:
  void openDisplay() {
    if (plan_.headless)
      offscreen_.emplace();
    else
      window_.emplace(render::Window::Options{.title = "Molar", .size_px = plan_.rig.screen.px});
  }

  std::unique_ptr<render::FrameRenderer> rendererWith(int samples, std::span<const std::uint8_t> solid) const {
    auto renderer = std::make_unique<render::FrameRenderer>(plan_.patient.ct.grid, solid, plan_.patient.ct.label,
                                                            render::RenderOptions{.samples = samples});
    renderer->setFace(plan_.patient.face);
    renderer->setGum(plan_.patient.gum);
    renderer->setInstrument(assets::surgicalHandpiece({.bur_radius_mm = plan_.command.bur_radius_mm}));
    return renderer;
  }

  bool isOver() {
    const double t_s = newest_.t_s + newest_.dt_s;
    return interrupted || input_.endAsked() || (duration_s_ && t_s >= *duration_s_);
  }

  void takeInput() {
    if (!window_) return;
    for (const render::WindowEvent& event : window_->takeEvents()) input_.take(event);
    if (hand_.mouse) hand_.mouse->setTarget({{input_.X_WT().rotation, input_.X_WT().translation_mm}, input_.pedal()});
    if (input_.takeSnapshotAsked()) takeWindowSnapshot();
  }

  /// The tick first, then the bricks: what that tick cut is in this very frame.
  void followServo() {
    newest_ = workstation_->newestTick();
    frame_.tool_visible = newest_.dt_s > 0.0;
    frame_.X_PT = {newest_.hand.X_PT.rotation, newest_.proxy_P.mm};
    if (newest_.drilling)
      frame_.bur_angle_rad = std::fmod(newest_.t_s * kBurTurnsPerSecond, 1.0) * 2.0 * calibration::kPi;
    upload_.bring(workstation_->bone(), *renderer_);
  }

  void drawFrame() {
    renderer_->render(frame_);
    if (window_) {
      renderer_->showOnWindow(window_->framebufferSize_px());
      window_->present();
    } else {
      renderer_->readPicture();
    }
    renderer_->throwIfError();
    ++frames_;
  }

  void showStatus() {
    if (!window_ || secondsSince(status_shown_) < 0.5) return;
    status_shown_ = Clock::now();
    const haptics::ServoFigures servo = workstation_->figures();
    char text[160];
    std::snprintf(text, sizeof text, "Molar   %.1f s   force %.2f N   depth %.2f mm   %s   servo p99 %.0f µs",
                  newest_.t_s, glm::length(newest_.served_force_P_N.xyz), newest_.depth_mm,
                  newest_.drilling ? "drilling" : "drill off", servo.work_p99_us);
    window_->setTitle(text);
  }

  /// Both eyes at full quality: `name_left.png`, `name_right.png`.
  void takeSnapshot(const std::string& path, std::span<const std::uint8_t> solid) {
    auto renderer = rendererWith(kSnapshotSamples, solid);
    render::Frame frame = frame_;
    frame.rig.screen.px = plan_.snapshot_px;
    for (const auto& [eye, word] : {std::pair{render::Eye::left, "left"}, std::pair{render::Eye::right, "right"}}) {
      renderer->renderEye(frame, eye);
      savePng(renderer->readEye(eye), withSuffix(path, word), plan_.overwrite);
    }
    renderer->throwIfError();
  }

  /// The window's own picture, under the first free number.
  void takeWindowSnapshot() {
    for (int n = 1; n < 10000; ++n) {
      char path[64];
      std::snprintf(path, sizeof path, "molar-snapshot-%04d.png", n);
      try {
        savePng(renderer_->readPicture(), path, false);
        workstation_->note("snapshot", path);
        std::fprintf(stderr, "molar: snapshot %s\n", path);
        return;
      } catch (const std::runtime_error&) {
        continue;
      }
    }
    std::fprintf(stderr, "molar: no snapshot: this folder can not be written\n");
  }

  void finish() {
    RehearsalFigures figures;
    const RecordingSummary recorded = workstation_->stop();
    // One more picture of what the bone has become.
    followServo();
    // A scripted hand that has withdrawn only hides its work.
    frame_.tool_visible = frame_.tool_visible && (hand_.mouse || newest_.depth_mm > 0.0);
    if (!plan_.snapshot.empty()) takeSnapshot(plan_.snapshot, workstation_->bone().solid());
    figures.patient_title = plan_.patient.title;
    figures.bur_radius_mm = plan_.command.bur_radius_mm;
    figures.duration_s = newest_.t_s + newest_.dt_s;
    figures.removed_mm3 = removedByTissue(plan_.patient.ct, workstation_->bone());
    figures.frames = frames_;
    figures.frame_ms = 1000.0 * loop_s_ / static_cast<double>(std::max<std::uint64_t>(1, frames_ - 1));
    figures.first_picture_s = first_picture_s_;
    figures.servo = workstation_->figures();
    figures.rate_Hz = plan_.rate_Hz;
    if (plan_.recording) figures.recording = recorded;
    std::fputs(summaryText(figures).c_str(), stdout);
  }

  Clock::time_point looping_since_, status_shown_;
  RehearsalPlan plan_;
  HandAtWork hand_;
  std::optional<double> duration_s_;
  HandInput input_;
  std::optional<render::OffscreenContext> offscreen_;
  std::optional<render::Window> window_;
  std::unique_ptr<render::FrameRenderer> renderer_;
  std::optional<Workstation> workstation_;
  BrickUpload upload_;
  render::Frame frame_;
  haptics::Tick newest_;
  std::uint64_t frames_ = 0;
  double first_picture_s_ = 0.0, loop_s_ = 0.0;
};

}  // namespace

void rehearse(RehearsalPlan plan) {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  Rehearsal(std::move(plan)).run();
}

}  // namespace app
