#include "app/calibrate/wizard_show.h"

#include <chrono>
#include <memory>
#include <thread>

#include "app/calibrate/page_album.h"
#include "app/calibrate/sounds.h"
#include "app/calibrate/stylus_source.h"
#include "app/calibrate/wizard.h"
#include "app/calibrate/wizard_pages.h"
#include "app/text/usage_error.h"
#include "render/display/eye_projection.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

/// Between two pictures for a robot in a hurry, which is not held up by the display.
constexpr auto kHurriedFrame = std::chrono::milliseconds(250);
/// How long the last page stands.
constexpr auto kLastPage = std::chrono::milliseconds(2500);

std::unique_ptr<StylusSource> sourceOf(const WizardRun& run) {
  if (run.device != nullptr) return std::make_unique<DeviceSource>(*run.device);
  if (!run.practice) throw UsageError("calibrate: no device, give one or practise");
  if (run.robot) return std::make_unique<RobotSource>(*run.practice, *run.robot, run.hurried);
  return std::make_unique<PracticeSource>(*run.practice);
}

class WizardShow {
 public:
  explicit WizardShow(const WizardRun& run) : run_(run), wizard_(run.plan), pages_(run.plan.record.rig.mirror) {
    if (!run.windows && (!run.robot || run.device != nullptr))
      throw UsageError("calibrate: without a window nobody sees what to do, let the robot practise");
    if (!run.pages.empty()) album_.emplace(run.pages);
    if (run.sounds) sounds_.emplace(run.tell);
    if (run.windows) screen_.emplace(run.display, run.plan.record.rig.screen.px, run.tell);
    source_ = sourceOf(run);
    view_ = wizard_.look();
  }

  WizardOutcome run() {
    while (!wizard_.isOver() && !left_) turn();
    if (!wizard_.isOver()) {
      WizardOutcome outcome = wizard_.outcome();
      outcome.end = WizardOutcome::End::declined;
      outcome.reason = "Left before the end: nothing is changed.";
      return outcome;
    }
    const auto until = Clock::now() + kLastPage;
    do {
      turn();
    } while (screen_ && !run_.hurried && !left_ && Clock::now() < until);
    return wizard_.outcome();
  }

 private:
  /// Events, ticks, picture, sounds.
  void turn() {
    const auto began = Clock::now();
    if (run_.given_up()) left_ = true;
    takeEvents();
    samples_.clear();
    source_->takeInto(samples_, view_);
    for (const StylusSample& sample : samples_) wizard_.feel(sample);
    view_ = wizard_.look();
    if (sounds_)
      for (const WizardSound sound : view_.sounds) sounds_->play(sound);
    show();
    if (!run_.hurried) std::this_thread::sleep_until(began + kPageTime);
  }

  void takeEvents() {
    if (!screen_) return;
    const render::EyeView eye = render::eyeView(pages_.rigOf(view_), render::Eye::cyclopean);
    const glm::dvec2 px = glm::max(screen_->window_px(), 1);
    for (const render::WindowEvent& event : screen_->takeEvents()) {
      const auto* key = std::get_if<render::KeyPressed>(&event);
      if (std::holds_alternative<render::CloseAsked>(event)) left_ = true;
      if (key != nullptr && key->down && key->key == render::Key::escape) left_ = true;
      source_->take(event, eye.right_edge_W.xyz / px.x, eye.up_edge_W.xyz / px.y);
    }
  }

  void show() {
    const double t_s = std::chrono::duration<double>(Clock::now() - began_).count();
    const auto draw = [&](const render::StereoLayout& layout) {
      return pages_.output(view_, source_->seen(), layout, t_s);
    };
    if (screen_ && (!run_.hurried || Clock::now() - shown_ > kHurriedFrame)) {
      screen_->show(draw);
      shown_ = Clock::now();
    }
    if (album_)
      album_->keep(view_, [&] {
        return draw({.mode = run_.display.mode, .screen_px = view_.screen.px, .swapped = run_.display.swapped});
      });
  }

  const WizardRun& run_;
  Wizard wizard_;
  WizardPages pages_;
  std::optional<PageAlbum> album_;
  std::optional<Sounds> sounds_;
  std::optional<WizardScreen> screen_;
  std::unique_ptr<StylusSource> source_;
  WizardView view_;
  std::vector<StylusSample> samples_;
  bool left_ = false;
  Clock::time_point began_ = Clock::now(), shown_;
};

}  // namespace

WizardOutcome runWizard(const WizardRun& run) { return WizardShow(run).run(); }

}  // namespace app
