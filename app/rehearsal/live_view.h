// The surgeon's view: display, renderer of patient and instruments, upload of carved bone, quality selection and
// latency estimate. A stepped rehearsal opens it at the first snapshot. Main thread; the cost is that of drawing.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/device/second_hand.h"
#include "app/instructor/rehearsal_status.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/view/brick_upload.h"
#include "app/view/head_up_line.h"
#include "app/view/motion_to_photon.h"
#include "app/view/quality_choice.h"
#include "app/view/snapshot.h"
#include "app/view/still_picture.h"
#include "app/view/surgeon_display.h"

namespace app {

/// What the display of a rehearsal is opened with.
SurgeonDisplay::Options displayOf(const RehearsalPlan& plan);

class LiveView {
 public:
  using Clock = SurgeonDisplay::Clock;

  /// Borrows the plan but takes over its windows, the command in force (whose tool is drawn) and the second hand, if
  /// any. Throws GpuError.
  LiveView(RehearsalPlan& plan, const haptics::Command& in_force, const SecondHand* second_hand, double servo_rate_Hz,
           ReportLine report);

  /// The bone to upload bricks from. Borrowed.
  void attach(haptics::Bodies& bodies) { bodies_ = &bodies; }

  /// Draws the frame until the quality for this machine is found, a few seconds at most.
  void settleQuality(const render::Frame& frame) {
    quality_->settle([&] { showLive(frame); });
  }
  /// At the live quality; refined after a while in which nothing moved (app/view/still_picture.h).
  void show(const render::Frame& frame, Clock::time_point now);
  void showLive(const render::Frame& frame);
  /// The text over the frames shown from now on.
  void setHeadUp(HeadUpContent content) { head_up_ = std::move(content); }
  /// Until no frame is queued; the pose read next is the newest that can be displayed.
  void waitUntilShown();
  /// Bricks carved until now, for the frame to show next: its pieces that have left rest are not in the jaw.
  void uploadBone(const render::Frame& frame);
  /// Bricks of the jaw's grid that have changed since the last call, uploaded or not yet.
  std::vector<glm::ivec3> takeChangedBricks() { return uploader_.takeChanged(*bodies_); }
  /// Between the bur of `frame` and the bone uploaded last; nothing before a view is open.
  std::optional<render::BoneGap> gapOf(const render::Frame& frame);
  /// After a change of tool.
  void showInstrument();
  /// A root-canal file as it lies in a tick, for the frame to show next; nothing for another tool.
  void showFile(const haptics::Tick& tick, const render::Frame& frame);
  /// What broken files have left in the tooth, from now on.
  void showFragments(std::span<const assets::MetalFragment> lying);
  /// True if the quality changed. Never during a stroke.
  bool adaptQuality(bool in_stroke) {
    return quality_ && still_.newest() == FrameDrawing::live && quality_->update(in_stroke);
  }

  /// Both eyes at full quality. `solid`: the bone, in the order of the patient's grid.
  void takeSnapshot(StereoSnapshot& snapshot, render::Frame frame, std::span<const std::uint8_t> solid);
  /// The frame and its text at the best quality of the ladder, whatever it is shown with. Throws GpuError.
  render::Image fullPicture(render::Frame frame);

  /// As shown last; in stereo the left eye's, without the text over it. Empty before the first frame, and where it is
  /// on its way from the graphics card: it comes with one of the next frames.
  render::Image shownPicture();

  SurgeonDisplay& display();
  /// Null: headless.
  render::Window* window() { return display_ ? display_->window() : nullptr; }
  std::string qualityText();
  const MotionToPhoton& latency() const { return latency_; }
  /// Drawn and shown, without those in which nothing moved, and the time without them.
  std::uint64_t frames() const { return frames_; }
  double still_s() const { return still_s_; }
  void describe(RehearsalStatus& status);

 private:
  void open();
  bool updateOverlay(const render::Frame& frame);
  std::unique_ptr<render::FrameRenderer> newRenderer(const render::RenderOptions& options,
                                                     std::span<const std::uint8_t> solid) const;

  RehearsalPlan& plan_;
  const haptics::Command& in_force_;
  const SecondHand* second_hand_;
  haptics::Bodies* bodies_ = nullptr;
  double servo_rate_Hz_;
  ReportLine report_;
  BrickUploader uploader_;
  std::optional<SurgeonDisplay> display_;
  std::optional<QualityChoice> quality_;
  HeadUpContent head_up_;
  HeadUpLine head_up_line_;
  bool overlay_is_new_ = true;  ///< to the renderer
  MotionToPhoton latency_;
  std::optional<Clock::time_point> pose_read_;
  std::uint64_t frames_ = 0;
  StillPicture still_;
  haptics::FileWork file_;  ///< as drawn last
  std::vector<assets::MetalFragment> fragments_;
  calibration::Pose<calibration::Patient, calibration::Tool> file_X_PT_;
  bool bone_changed_ = false;                    ///< since the newest frame
  std::vector<HeadUpWarning> shown_warnings_;    ///< in the newest frame
  std::optional<Clock::time_point> still_seen_;  ///< the newest frame in which nothing moved
  double still_s_ = 0.0;
};

}  // namespace app
