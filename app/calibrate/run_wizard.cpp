#include "app/calibrate/run_wizard.h"

#include <thread>

#include "app/calibrate/page_album.h"
#include "app/calibrate/page_lines.h"
#include "app/calibrate/wizard.h"
#include "app/calibrate/wizard_pages.h"

namespace app {
namespace {

/// Between two pictures for a robot in a hurry, which is not held up by the display.
constexpr auto kHurriedFrame = std::chrono::milliseconds(250);
/// How long the last page stands.
constexpr auto kLastPage = std::chrono::milliseconds(2500);

class WizardShow : GuidedProcedure {
 public:
  explicit WizardShow(const WizardRun& run)
      : GuidedProcedure(run, run.plan.record.rig.screen.px, run.robot.has_value()),
        run_(run),
        wizard_(run.plan),
        pages_(run.plan.record.rig.mirror) {
    if (!run.pages.empty()) album_.emplace(run.pages);
    if (!source_) source_ = std::make_unique<RobotSource>(*run.practice, *run.robot, run.hurried);
    view_ = wizard_.takeView();
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
    takeEvents(pages_.rigOf(view_));
    samples_.clear();
    source_->takeInto(samples_, view_);
    for (const StylusSample& sample : samples_) wizard_.update(sample);
    view_ = wizard_.takeView();
    if (isPractisedByHand()) view_.practice_keys = kPracticeKeys;
    if (run_.tells)
      for (const std::string& line : lines_.newOf(view_)) run_.report(line);
    if (sounds_)
      for (const WizardSound sound : view_.sounds) sounds_->play(sound);
    show();
    if (!run_.hurried) std::this_thread::sleep_until(began + kPageTime);
  }

  void show() {
    const double t_s = shownFor_s();
    const auto draw = [&](const render::StereoLayout& layout) {
      return pages_.output(view_, trueStylus(), layout, t_s);
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
  PageLines lines_;
  Clock::time_point shown_;
};

}  // namespace

WizardOutcome runWizard(const WizardRun& run) { return WizardShow(run).run(); }

}  // namespace app
