#include "app/rehearsal/live_picture.h"

#include <utility>

#include "app/view/dressed_renderer.h"
#include "haptics/bone/carved_bone.h"

namespace app {
namespace {

constexpr int kSnapshotSamples = 2;
constexpr double kUsualRefresh_Hz = 60.0;

double secondsBetween(LivePicture::Clock::time_point from, LivePicture::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

SurgeonDisplay::Options displayOf(const RehearsalPlan& plan) {
  return {.windows = {.mode = plan.display,
                      .screen_px = plan.rig.screen.px,
                      .full_screen = plan.full_screen,
                      .monitor = plan.monitor},
          .eyes_swapped = plan.eyes_swapped,
          .backend = plan.backend,
          .headless = plan.headless,
          .needs_window = plan.device == "mouse"};
}

}  // namespace

LivePicture::LivePicture(const RehearsalPlan& plan, const haptics::Command& in_force, const SecondHand* second_hand,
                         double servo_rate_Hz, Tell tell)
    : plan_(plan),
      in_force_(in_force),
      second_hand_(second_hand),
      servo_rate_Hz_(servo_rate_Hz),
      tell_(std::move(tell)),
      latency_(kUsualRefresh_Hz, servo_rate_Hz) {
  if (plan.ticking == Ticking::by_itself) open();
}

void LivePicture::open() {
  display_.emplace(
      displayOf(plan_), [this](render::Backend backend) { return newRenderer(backend); }, tell_);
  quality_.emplace(*display_, plan_.quality_step);
  latency_ = MotionToPhoton(display_->refresh_Hz(), servo_rate_Hz_);
}

SurgeonDisplay& LivePicture::display() {
  if (!display_) open();
  return *display_;
}

/// In the current context, from the bone as it is.
std::unique_ptr<render::FrameRenderer> LivePicture::newRenderer(render::Backend backend) {
  auto renderer =
      dressedRenderer(plan_.patient, in_force_.tool, plan_.cut, plan_.patient.ct.solid, {.backend = backend});
  if (second_hand_ != nullptr) second_hand_->dress(*renderer);
  if (bone_ != nullptr) upload_.bringAgain(*bone_, *renderer);
  return renderer;
}

void LivePicture::settle(const render::Frame& frame) {
  quality_->settle([&] { show(frame); });
}

void LivePicture::show(const render::Frame& frame) {
  display();
  render::Frame drawn = frame;
  if (quality_->rules()) drawn.quality = quality_->quality();
  display_->show(drawn);
  ++pictures_;
}

void LivePicture::waitUntilShown() {
  display_->waitUntilShown();
  if (display_->window() != nullptr && pose_read_) latency_.add(secondsBetween(*pose_read_, display_->handedOver()));
  pose_read_ = Clock::now();
}

void LivePicture::bringBone() {
  if (display_) upload_.bring(*bone_, display_->renderer());
}

void LivePicture::showInstrument() {
  if (display_) app::showInstrument(display_->renderer(), in_force_.tool);
}

void LivePicture::take(EyePictures& pictures, render::Frame frame, std::span<const std::uint8_t> solid) {
  const auto renderer = display().newRenderer([&](render::Backend backend) {
    return dressedRenderer(plan_.patient, in_force_.tool, plan_.cut, solid,
                           {.backend = backend, .samples = kSnapshotSamples});
  });
  if (second_hand_ != nullptr) second_hand_->dress(*renderer);
  frame.quality = {};
  frame.rig.screen.px = plan_.snapshot_px;
  pictures.take(*renderer, frame);
}

void LivePicture::measureRate(Clock::time_point now) {
  const double since_s = secondsBetween(rate_measured_, now);
  if (since_s <= 0.0) return;
  pictures_per_s_ = static_cast<double>(pictures_ - pictures_measured_) / since_s;
  pictures_measured_ = pictures_;
  rate_measured_ = now;
}

void LivePicture::describe(RehearsalStatus& status) {
  status.quality = qualityText();
  if (!display_) return;
  status.display = std::string(render::nameOf(display_->mode()));
  status.drawing_ms = 1000.0 * display_->drawing_s();
  status.pictures_per_s = pictures_per_s_;
  status.refresh_Hz = display_->refresh_Hz();
  status.budget_ms = 1000.0 * quality_->budget_s();
  status.latency = latency_.now();
  status.quality_step = quality_->step();
  status.quality_is_held = quality_->isHeld();
}

void LivePicture::describe(RehearsalFigures& figures) const {
  figures.frames = pictures_;
  if (latency_.pictures() == 0) return;
  figures.latency = latency_.median();
  figures.slow_latency = latency_.slow();
}

}  // namespace app
