// What the other hand holds, a mirror or a retractor, and the device that follows it. It is seen, never felt: the
// device is told no force, its motors stay off, and the instrument touches nothing and cuts nothing. Main thread; the
// device has its own. Construction opens the device (start-up only), start() begins to follow it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/device/pose_source.h"
#include "haptics/loop/instrument_tracker.h"
#include "render/frame_renderer.h"

namespace app {

enum class SecondTool { mirror, retractor };

struct SecondHandPlan {
  std::string device;  ///< its address; empty: the other hand holds nothing
  SecondTool tool = SecondTool::mirror;
};
inline constexpr const char* kSecondHandHelp =
    "The other hand, seen but not felt: scripted, holding still beside the site; replay:SESSION; or a device as "
    "--device takes it";

/// How the other hand holds its instrument by script: beside the tooth at work, on the side of the tongue. The glass of
/// a mirror looks half towards the eye and half towards the tooth; a retractor holds the tongue away from it.
calibration::Pose<calibration::World, calibration::OtherTool> scriptedHold(SecondTool tool, bool right_side);

/// Throws UsageError for what is no second hand.
void refuseUnlessSecondHand(const SecondHandPlan& plan, const std::string& first_device);

class SecondHand {
 public:
  /// Throws as openPoseSource does. A device's base stands where the rig says (X_WD2), else so that the middle of its
  /// workspace is where the script would hold the instrument.
  SecondHand(const SecondHandPlan& plan, const DeviceOptions& options, const assets::Patient& patient,
             const calibration::Rig& rig, Ticking ticking = Ticking::realtime);

  /// As people read it: "mirror, scripted still hand".
  const std::string& name() const { return name_; }
  void start() { hand_->start(); }
  /// By hand alone: all its ticks up to this time of the rehearsal.
  void stepTo(double t_s);

  /// The renderer then has the instrument.
  void dress(render::FrameRenderer& renderer) const;
  /// Where the instrument is now; not seen while the device brings nothing to believe.
  void place(render::Frame& frame);
  /// Once, when it can no longer be followed, and when it can again.
  std::optional<std::string> takeNews();

 private:
  SecondTool tool_;
  PoseSource device_;
  std::string name_;
  double rate_Hz_;
  std::unique_ptr<haptics::InstrumentTracker> hand_;  // stops before its device goes
  bool is_seen_ = false, was_seen_ = false, was_lost_ = false;
};

}  // namespace app
