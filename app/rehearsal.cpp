#include "app/rehearsal.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <span>

#include "app/brick_upload.h"
#include "app/command_settings.h"
#include "app/hand_input.h"
#include "app/law_text.h"
#include "app/live_parameters.h"
#include "app/rehearsal_summary.h"
#include "app/snapshot.h"
#include "app/tool_text.h"
#include "app/trough_plan.h"
#include "app/usage_error.h"
#include "assets/instrument.h"
#include "calibration/geometry/units.h"
#include "haptics/device/mouse_device.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_device.h"
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
  if (plan.hand != Hand::mouse) {
    auto trough = planBuccalTrough(plan.patient, plan.command.tool.head.radius_mm);
    if (!trough) throw UsageError("--device: this patient has no third molar with bone beside it, use --device mouse");
    trough->shaft_D = {glm::conjugate(plan.rig.X_WP.rotation) * shaftDirection_W()};
    if (plan.hand == Hand::simulated) {
      auto simulated = std::make_unique<haptics::SimulatedDevice>(*trough, haptics::SimulatedMechanics{});
      hand.duration_s = simulated->duration_s();
      hand.device = std::move(simulated);
      return hand;
    }
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

/// What is felt and cuts is what is drawn.
assets::InstrumentParameters drawnAs(const haptics::Tool& tool) {
  assets::InstrumentParameters drawn;
  drawn.form = static_cast<assets::BurForm>(tool.head.kind);
  drawn.bur_radius_mm = tool.head.radius_mm;
  drawn.bur_length_mm = tool.head.length_mm;
  drawn.neck_radius_mm = tool.shaft.radius_mm;
  return drawn;
}
static_assert(static_cast<int>(assets::BurForm::cone) == static_cast<int>(haptics::ShapeKind::cone));

double width_mm(const calibration::ScreenCorners& screen) {
  return glm::distance(screen.lower_left.mm, screen.lower_right.mm);
}

/// One rehearsal from the first frame on.
class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        hand_(handOf(plan_)),
        duration_s_(plan_.seconds ? plan_.seconds : hand_.duration_s),
        input_(restingTool()),
        device_damping_Ns_per_mm_(hand_.device->capabilities().damping_Ns_per_mm) {
    if (!plan_.parameters.empty()) {
      parameters_.emplace(plan_.parameters, plan_.command, [this](const haptics::Command& c) { check(c); });
      plan_.command = parameters_->first();
    }
    check(plan_.command);
    // Every output is claimed before any work.
    if (!plan_.snapshot.empty()) closing_pictures_.emplace(plan_.snapshot, plan_.overwrite);
    if (!plan_.first_snapshot.empty()) first_pictures_.emplace(plan_.first_snapshot, plan_.overwrite);
    openDisplay();
    renderer_ = rendererWith(1, plan_.patient.ct.solid);
    frame_.rig = plan_.rig;
    frame_.display = plan_.display;
    frame_.eyes_swapped = plan_.eyes_swapped;
    frame_.bur_radius_mm = plan_.command.tool.head.radius_mm;
    frame_.face_window_mm = plan_.face_window_mm;
    frame_.site_P = {plan_.patient.site.third_molar_P_mm};
    frame_.tool_visible = false;
    workstation_.emplace(plan_.patient, std::move(hand_.device),
                         haptics::ServoSettings{plan_.rate_Hz, hand_.X_PD, {}, true}, plan_.command, plan_.recording);
  }

  void run() {
    drawFrame();
    first_picture_s_ = secondsSince(plan_.begun);
    if (first_pictures_) takePictures(*first_pictures_, plan_.patient.ct.solid);
    workstation_->start();
    workstation_->note("start", plan_.hand == Hand::mouse      ? "mouse"
                                : plan_.hand == Hand::scripted ? "scripted hand"
                                                               : "simulated device");
    looping_since_ = Clock::now();
    while (!isOver()) {
      takeInput();
      takeParameters();
      followServo();
      followGuide();
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
      window_.emplace(
          render::Window::Options{.title = "Molar", .size_px = plan_.rig.screen.px, .full_screen = plan_.full_screen});
  }

  std::unique_ptr<render::FrameRenderer> rendererWith(int samples, std::span<const std::uint8_t> solid) const {
    auto renderer = std::make_unique<render::FrameRenderer>(plan_.patient.ct.grid, solid, plan_.patient.ct.label,
                                                            render::RenderOptions{.samples = samples});
    renderer->setFace(plan_.patient.face);
    renderer->setGum(plan_.patient.gum);
    renderer->setInstrument(assets::surgicalHandpiece(drawnAs(plan_.command.tool)));
    return renderer;
  }

  bool isOver() {
    const double t_s = newest_.t_s + newest_.dt_s;
    return interrupted || input_.endAsked() || (plan_.guide && plan_.guide->isOver()) ||
           (duration_s_ && t_s >= *duration_s_);
  }

  void takeInput() {
    if (!window_) return;
    const double mm_per_px = width_mm(plan_.rig.screen) / std::max(1, window_->framebufferSize_px().x);
    for (const render::WindowEvent& event : window_->takeEvents())
      if (!isForGuide(event)) input_.take(event, mm_per_px);
    if (hand_.mouse) hand_.mouse->setTarget({{input_.X_WT().rotation, input_.X_WT().translation_mm}, input_.pedal()});
    if (input_.takeSnapshotAsked()) takeWindowSnapshot();
    if (plan_.guide) return;
    if (input_.takeDrillSwitchAsked()) {
      plan_.command.drill_enabled = !plan_.command.drill_enabled;
      workstation_->change(plan_.command);
    }
    if (const auto number = input_.takeNumberAsked(); number && *number < static_cast<int>(haptics::kLaws.size()))
      switchLaw(haptics::kLaws[static_cast<std::size_t>(*number)].kind);
  }

  bool isForGuide(const render::WindowEvent& event) const {
    const auto* key = std::get_if<render::KeyPressed>(&event);
    if (!plan_.guide || !key || !key->down || key->repeated) return false;
    const int code = static_cast<int>(key->key);
    return code > ' ' && code <= 'Z' && plan_.guide->press(static_cast<char>(code));
  }

  void followGuide() {
    if (!plan_.guide) return;
    if (const auto wanted = plan_.guide->follow(newest_)) {
      plan_.command = *wanted;
      workstation_->change(plan_.command);
    }
  }

  /// Refuses what the servo or the device would obey only in part.
  void check(const haptics::Command& command) const {
    refuseUnlessObeyed(command);
    refuseUnlessHeld(command, device_damping_Ns_per_mm_, plan_.rate_Hz);
  }

  void switchLaw(haptics::LawKind law) {
    haptics::Command wanted = plan_.command;
    wanted.law.kind = law;
    try {
      change(loweredUntilHeld(wanted, device_damping_Ns_per_mm_, plan_.rate_Hz));
    } catch (const UsageError& error) {
      std::fprintf(stderr, "molar: %s; the old law stays\n", error.what());
    }
  }

  void takeParameters() {
    if (!parameters_) return;
    const auto reading = parameters_->look(Clock::now());
    if (!reading) return;
    if (reading->command) {
      haptics::Command wanted = *reading->command;
      wanted.drill_enabled = plan_.command.drill_enabled;
      change(wanted);
    } else {
      std::fprintf(stderr, "molar: %s\n", reading->trouble.c_str());
      workstation_->note("parameters", reading->trouble);
    }
  }

  /// In force, recorded, and every difference logged.
  void change(const haptics::Command& wanted) {
    const std::vector<std::string> changes = changesBetween(plan_.command, wanted);
    if (changes.empty()) return;
    const bool other_bur = !(plan_.command.tool.head == wanted.tool.head);
    plan_.command = wanted;
    workstation_->change(plan_.command);
    for (const std::string& line : changes) {
      std::fprintf(stderr, "molar: at %.3f s %s\n", newest_.t_s, line.c_str());
      workstation_->note("parameters", line);
    }
    if (other_bur) showBur();
  }

  void showBur() {
    frame_.bur_radius_mm = plan_.command.tool.head.radius_mm;
    renderer_->setInstrument(assets::surgicalHandpiece(drawnAs(plan_.command.tool)));
  }

  /// The tick first, then the bricks: what that tick cut is in this very frame.
  void followServo() {
    newest_ = workstation_->newestTick();
    frame_.tool_visible = newest_.dt_s > 0.0;
    // The servo holds the bur where it last believed the hand; so does the picture.
    if (!haptics::has(newest_.faults, haptics::Fault::bad_pose)) frame_.X_PT.rotation = newest_.hand.X_PT.rotation;
    frame_.X_PT.translation_mm = newest_.proxy_P.mm;
    if (newest_.drilling)
      frame_.bur_angle_rad = std::fmod(newest_.t_s * kBurTurnsPerSecond, 1.0) * 2.0 * calibration::kPi;
    upload_.bring(workstation_->bone(), *renderer_);
  }

  void drawFrame() {
    renderer_->render(frame_);
    if (window_) {
      renderer_->showOnWindow({.size_px = window_->framebufferSize_px()});
      window_->present();
    } else {
      renderer_->readPicture();
    }
    renderer_->throwIfError();
    ++frames_;
  }

  void showStatus() {
    if (secondsSince(status_shown_) < 0.5) return;
    status_shown_ = Clock::now();
    noteTrouble();
    if (!window_) return;
    if (plan_.guide) {
      window_->setTitle(plan_.guide->words());
      return;
    }
    const haptics::ServoFigures servo = workstation_->figures();
    char text[160];
    std::snprintf(text, sizeof text, "Molar   %.1f s   %s   force %.2f N   depth %.2f mm   %s   servo p99 %.0f µs",
                  newest_.t_s, lawName(plan_.command.law.kind).c_str(), glm::length(newest_.served_force_P_N.xyz),
                  newest_.depth_mm,
                  newest_.drilling              ? "drilling"
                  : plan_.command.drill_enabled ? "drill off"
                                                : "drill locked",
                  servo.work_p99_us);
    window_->setTitle(recording_ended_ ? std::string(text) + "   NOT RECORDING" : std::string(text));
  }

  /// Says and records, once, that the recording ended early or the device can not be believed.
  void noteTrouble() {
    if (const auto trouble = workstation_->recordingTrouble(); trouble && !recording_ended_) {
      recording_ended_ = true;
      std::fprintf(stderr, "molar: recording ended: %s\n", trouble->c_str());
    }
    const bool faulty =
        haptics::has(newest_.faults, haptics::Fault::bad_pose | haptics::Fault::device | haptics::Fault::bad_force);
    if (faulty != faulty_) workstation_->note("fault", faulty ? "hand not believed, force let down" : "over");
    faulty_ = faulty;
  }

  /// Both eyes at full quality: `name_left.png`, `name_right.png`.
  void takePictures(EyePictures& pictures, std::span<const std::uint8_t> solid) const {
    auto renderer = rendererWith(kSnapshotSamples, solid);
    render::Frame frame = frame_;
    frame.rig.screen.px = plan_.snapshot_px;
    renderer->renderEye(frame, render::Eye::left);
    renderer->renderEye(frame, render::Eye::right);
    renderer->throwIfError();
    pictures.save(renderer->readEye(render::Eye::left), renderer->readEye(render::Eye::right));
  }

  /// The window's own picture, under the first free number.
  void takeWindowSnapshot() {
    std::string path;
    for (int n = 1; path.empty() || std::filesystem::exists(path); ++n)
      path = "molar-snapshot-" + std::to_string(n) + ".png";
    try {
      assets::OutputFile file(path, false);
      savePng(renderer_->readPicture(), file);
      workstation_->note("snapshot", path);
      std::fprintf(stderr, "molar: snapshot %s\n", path.c_str());
    } catch (const std::runtime_error& error) {
      std::fprintf(stderr, "molar: no snapshot: %s\n", error.what());
    }
  }

  void finish() {
    RehearsalFigures figures;
    workstation_->note("end", interrupted ? "interrupted" : input_.endAsked() ? "by the user" : "time over");
    const RecordingSummary recorded = workstation_->stop();
    // One more picture of what the bone has become.
    followServo();
    // A scripted hand that has withdrawn only hides its work.
    frame_.tool_visible = frame_.tool_visible && (hand_.mouse || newest_.depth_mm > 0.0);
    if (closing_pictures_) takePictures(*closing_pictures_, workstation_->bone().solidInGridOrder());
    figures.patient_title = plan_.patient.title;
    figures.bur = textOf(plan_.command.tool.head);
    figures.duration_s = newest_.t_s + newest_.dt_s;
    figures.removed_mm3 = workstation_->bone().removedByTissue_mm3();
    figures.frames = frames_;
    figures.frame_ms = 1000.0 * loop_s_ / static_cast<double>(std::max<std::uint64_t>(1, frames_ - 1));
    figures.first_picture_s = first_picture_s_;
    figures.servo = workstation_->figures();
    figures.rate_Hz = plan_.rate_Hz;
    if (plan_.recording) figures.recording = recorded;
    std::fputs(summaryText(figures).c_str(), plan_.guide ? stderr : stdout);
  }

  Clock::time_point looping_since_, status_shown_;
  RehearsalPlan plan_;
  HandAtWork hand_;
  std::optional<double> duration_s_;
  HandInput input_;
  double device_damping_Ns_per_mm_;
  std::optional<EyePictures> first_pictures_, closing_pictures_;
  std::optional<render::OffscreenContext> offscreen_;
  std::optional<render::Window> window_;
  std::unique_ptr<render::FrameRenderer> renderer_;
  std::optional<Workstation> workstation_;
  std::optional<LiveParameters> parameters_;
  BrickUpload upload_;
  render::Frame frame_;
  haptics::Tick newest_;
  std::uint64_t frames_ = 0;
  double first_picture_s_ = 0.0, loop_s_ = 0.0;
  bool recording_ended_ = false, faulty_ = false;
};

}  // namespace

void rehearse(RehearsalPlan plan) {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  Rehearsal(std::move(plan)).run();
}

}  // namespace app
