#include "app/rehearsal/live_view.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/view/patient_renderer.h"
#include "render/quality_ladder.h"

namespace app {
namespace {

constexpr int kSnapshotSamples = 2;
constexpr double kUsualRefresh_Hz = 60.0;
constexpr std::chrono::milliseconds kLookForMotion{4}, kPresentAgain{250};

}  // namespace

SurgeonDisplay::Options displayOf(const RehearsalPlan& plan) {
  return {.windows = {.mode = plan.display,
                      .screen_px = plan.rig.screen.px,
                      .full_screen = plan.full_screen,
                      .monitor = plan.monitor},
          .eyes_swapped = plan.eyes_swapped,
          .backend = plan.backend,
          .headless = plan.headless,
          .needs_window = plan.device == "mouse" || plan.second_hand.device == "mouse"};
}

LiveView::LiveView(RehearsalPlan& plan, const haptics::Command& in_force, const SecondHand* second_hand,
                   double servo_rate_Hz, ReportLine report)
    : plan_(plan),
      in_force_(in_force),
      second_hand_(second_hand),
      servo_rate_Hz_(servo_rate_Hz),
      report_(std::move(report)),
      latency_(kUsualRefresh_Hz, servo_rate_Hz),
      fragments_(plan.patient.fragments) {
  if (plan.ticking == Ticking::realtime) open();
}

void LiveView::open() {
  const auto renderer_of_current_bone = [this](render::Backend backend) {
    auto renderer = newRenderer({.backend = backend}, plan_.patient.ct.solid);
    if (bodies_ != nullptr) uploader_.uploadAllAgain(*bodies_, *renderer);
    overlay_is_new_ = true;
    return renderer;
  };
  display_.emplace(displayOf(plan_), renderer_of_current_bone, report_, std::move(plan_.windows));
  quality_.emplace(*display_, plan_.quality_step);
  latency_ = MotionToPhoton(display_->refresh_Hz(), servo_rate_Hz_);
}

SurgeonDisplay& LiveView::display() {
  if (!display_) open();
  return *display_;
}

std::unique_ptr<render::FrameRenderer> LiveView::newRenderer(const render::RenderOptions& options,
                                                             std::span<const std::uint8_t> solid) const {
  auto renderer = patientRenderer(plan_.patient, in_force_.tool, plan_.cut, solid, options);
  if (in_force_.tool.isFile()) app::showFile(*renderer, in_force_.tool.file, file_, file_X_PT_);
  app::showFragments(*renderer, fragments_);
  if (second_hand_ != nullptr) second_hand_->dress(*renderer);
  return renderer;
}

void LiveView::showLive(const render::Frame& frame) {
  display();
  render::Frame drawn = frame;
  if (quality_->overridesFrame()) drawn.quality = quality_->quality();
  updateOverlay(drawn);
  display_->show(drawn);
  still_.forget();
  ++frames_;
}

void LiveView::show(const render::Frame& frame, Clock::time_point now) {
  display();
  if (!quality_->isReduced()) return showLive(frame);
  const bool changed = std::exchange(bone_changed_, false) || shown_warnings_ != head_up_.warnings;
  shown_warnings_ = head_up_.warnings;
  render::Frame drawn = frame;
  drawn.quality = quality_->quality();
  const FrameDrawing step = still_.next(drawn, changed, now);
  const bool text_changed = updateOverlay(drawn);
  if (step != FrameDrawing::kept) {
    app::show(*display_, drawn, step);
    ++frames_;
    still_seen_.reset();
    return;
  }
  // An uncovered or resized window is filled again.
  if (text_changed || now - display_->presentedAt() > kPresentAgain) app::show(*display_, drawn, step);
  if (still_seen_) still_s_ += std::chrono::duration<double>(now - *still_seen_).count();
  still_seen_ = now;
}

std::string LiveView::qualityText() {
  if (!quality_) return "no frames displayed";
  return still_.newest() == FrameDrawing::live ? quality_->text() : "full while nothing moves";
}

/// Where the site is seen decides the edge of the text. True if it changed.
bool LiveView::updateOverlay(const render::Frame& frame) {
  calibration::Rig rig = frame.rig;
  rig.screen.px = display().imageSize_px(rig);
  render::FrameRenderer& renderer = display_->renderer();
  if (!head_up_line_.update(head_up_, headUpPlace(rig, display_->mode(), frame)) && !overlay_is_new_) return false;
  renderer.setOverlay(head_up_line_.panels());
  overlay_is_new_ = false;
  return true;
}

void LiveView::waitUntilShown() {
  // Nothing was drawn for a pose: the next movement is looked for soon, without using a core.
  if (still_.newest() == FrameDrawing::kept) {
    pose_read_.reset();
    std::this_thread::sleep_for(kLookForMotion);
    return;
  }
  display_->waitUntilShown();
  if (display_->window() != nullptr && pose_read_)
    latency_.add(std::chrono::duration<double>(display_->presentedAt() - *pose_read_).count());
  pose_read_ = Clock::now();
}

void LiveView::uploadBone(const render::Frame& frame) {
  if (display_ && uploader_.upload(*bodies_, frame.pieces, display_->renderer()) > 0) bone_changed_ = true;
}

std::optional<render::BoneGap> LiveView::gapOf(const render::Frame& frame) {
  // Of a file its canal counts.
  if (!display_ || !frame.tool_visible || in_force_.tool.isFile()) return {};
  return display_->renderer().gap(frame);
}

void LiveView::showInstrument() {
  if (display_) app::showInstrument(display_->renderer(), in_force_.tool);
  still_.forget();
}

void LiveView::showFile(const haptics::Tick& tick, const render::Frame& frame) {
  if (!in_force_.tool.isFile()) return;
  file_ = tick.file;
  file_X_PT_ = frame.X_PT;
  if (display_) app::showFile(display_->renderer(), in_force_.tool.file, file_, file_X_PT_);
}

void LiveView::showFragments(std::span<const assets::MetalFragment> lying) {
  fragments_.assign(lying.begin(), lying.end());
  if (display_) app::showFragments(display_->renderer(), fragments_);
  still_.forget();
}

void LiveView::takeSnapshot(StereoSnapshot& snapshot, render::Frame frame, std::span<const std::uint8_t> solid) {
  // A tooth out of the jaw keeps the colours that were blended with it in the jaw.
  const bool any_moved = std::ranges::any_of(frame.pieces, [](const auto& X_PQ) { return X_PQ.has_value(); });
  const auto renderer = display().newRenderer([&](render::Backend backend) {
    return newRenderer({.backend = backend, .samples = kSnapshotSamples}, any_moved ? plan_.patient.ct.solid : solid);
  });
  const haptics::Filling* const filling = bodies_->filling();
  if (any_moved || (filling != nullptr && !filling->isEmpty()))
    BrickUploader().uploadEverything(*bodies_, frame.pieces, *renderer);
  frame.quality = {};
  frame.rig.screen.px = plan_.snapshot_px;
  frame.gap = frame.tool_visible && !in_force_.tool.isFile() ? renderer->gap(frame) : std::nullopt;
  snapshot.take(*renderer, frame);
}

render::Image LiveView::fullPicture(render::Frame frame) {
  frame.quality = render::kQualitySteps.front().quality;
  updateOverlay(frame);
  still_.forget();
  return display().picture(frame);
}

render::Image LiveView::shownPicture() {
  if (!display_ || frames_ == 0) return {};
  display_->makeCurrent();
  const bool is_mono = display_->mode() == render::DisplayMode::mono;
  const auto eye = is_mono ? std::nullopt : std::optional(render::Eye::left);
  return display_->renderer().readLate(kSpectatorPicture_px, eye).value_or(render::Image());
}

void LiveView::describe(RehearsalStatus& status) {
  status.quality = qualityText();
  if (!display_) return;
  status.display = std::string(render::nameOf(display_->mode()));
  status.drawing_ms = 1000.0 * display_->drawing_s();
  status.refresh_Hz = display_->refresh_Hz();
  status.budget_ms = 1000.0 * quality_->budget_s();
  status.latency = latency_.now();
  status.quality_step = quality_->step();
  status.quality_is_held = quality_->isHeld();
}

}  // namespace app
