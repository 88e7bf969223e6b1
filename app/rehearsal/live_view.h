// What the surgeon sees of a rehearsal: the display, a renderer dressed with patient, instrument and other hand, the
// bone as it is carved, at the quality that this machine holds, and how late it is. Where nobody watches it is opened
// by the first picture that is asked for. Main thread; a frame costs what drawing it costs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/device/second_hand.h"
#include "app/instructor/rehearsal_status.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/rehearsal_summary.h"
#include "app/view/brick_upload.h"
#include "app/view/motion_to_photon.h"
#include "app/view/quality_choice.h"
#include "app/view/snapshot.h"
#include "app/view/surgeon_display.h"

namespace app {

class LiveView {
 public:
  using Clock = SurgeonDisplay::Clock;
  using ReportLine = SurgeonDisplay::ReportLine;

  /// Borrows the plan, the command in force (whose tool is drawn) and the other hand, if there is one. Throws GpuError.
  LiveView(const RehearsalPlan& plan, const haptics::Command& in_force, const SecondHand* second_hand,
           double servo_rate_Hz, ReportLine report);

  /// From now on what is carved of this bone is brought over. Borrowed.
  void follow(haptics::CarvedBone& bone) { bone_ = &bone; }

  /// Draws so many pictures as report what this machine can.
  void settle(const render::Frame& frame);
  void show(const render::Frame& frame);
  /// Until nothing is on its way any more; the pose read next is the newest that can be seen.
  void waitUntilShown();
  /// What was carved until now, for the next frame; the pose was read just before.
  void uploadBone();
  /// The instrument in the hand is another.
  void showInstrument();
  /// True: the quality is another from now on. Never during a stroke.
  bool adaptQuality(bool stroke) { return quality_ && quality_->follow(stroke); }

  /// Both eyes at full quality, of the bone as given in the order of the patient's grid.
  void take(StereoSnapshot& pictures, render::Frame frame, std::span<const std::uint8_t> solid);
  /// The one that was shown last.
  render::Image newest() { return display().renderer().readImage(); }

  SurgeonDisplay& display();
  /// Null: none, and none is wanted.
  render::Window* window() { return display_ ? display_->window() : nullptr; }
  std::string qualityText() { return quality_ ? quality_->text() : "no pictures on the way"; }
  const MotionToPhoton& latency() const { return latency_; }
  /// Since the last call.
  void measureRate(Clock::time_point now);
  std::uint64_t pictures() const { return pictures_; }
  void describe(RehearsalStatus& status);
  void describe(RehearsalFigures& figures) const;

 private:
  void open();
  std::unique_ptr<render::FrameRenderer> newRenderer(render::Backend backend);

  const RehearsalPlan& plan_;
  const haptics::Command& in_force_;
  const SecondHand* second_hand_;
  haptics::CarvedBone* bone_ = nullptr;
  double servo_rate_Hz_;
  ReportLine report_;
  BrickUpload upload_;
  std::optional<SurgeonDisplay> display_;
  std::optional<QualityChoice> quality_;
  MotionToPhoton latency_;
  std::optional<Clock::time_point> pose_read_;
  Clock::time_point rate_measured_ = Clock::now();
  std::uint64_t pictures_ = 0, pictures_measured_ = 0;
  double pictures_per_s_ = 0.0;
};

}  // namespace app
