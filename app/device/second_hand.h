// The second hand: a mirror or a retractor, and the device that moves it. It is seen, not felt: its device gets no
// force, its motors stay off, the instrument neither touches nor cuts. Main thread; the device has its own.
// Construction opens the device (start-up only), start() begins to track it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/device/pose_source.h"
#include "app/session/second_hand_event.h"
#include "assets/instrument/second_instrument.h"
#include "haptics/loop/instrument_tracker.h"
#include "render/frame_renderer.h"

namespace app {

using SecondTool = assets::SecondInstrument;

struct SecondHandPlan {
  std::string device;  ///< its address; empty: no second hand
  SecondTool tool = SecondTool::mirror;
};
inline constexpr const char* kSecondHandHelp =
    "The second hand, seen but not felt: scripted, holding still at the site; mouse, while O is held; replay:SESSION, "
    "its second hand or else its first; or a device as --device takes it";

/// The scripted pose of the instrument: next to the tooth at work, on the side of the tongue. The mirror reflects the
/// tooth towards the eye; the retractor holds the tongue away.
calibration::Pose<calibration::World, calibration::OtherTool> scriptedHold(SecondTool tool, bool right_side);

/// What reflects the scene; none: nothing of it does.
std::optional<render::MirrorGlass> glassOf(SecondTool tool);

/// Throws UsageError for an address that cannot be a second hand.
void refuseUnlessSecondHand(const SecondHandPlan& plan, const std::string& first_device);

class SecondHand {
 public:
  /// Throws as openPoseSource. The device's base stands where the rig says (X_WD2), else so that the middle of its
  /// workspace is at the scripted pose. Without orientation the instrument keeps the scripted one.
  SecondHand(const SecondHandPlan& plan, const DeviceOptions& options, const assets::Patient& patient,
             const calibration::Rig& rig, Ticking ticking = Ticking::realtime);

  /// "mirror, scripted still hand".
  const std::string& name() const { return name_; }
  void start() { hand_->start(); }
  /// Stepped only: all its ticks up to this time of the rehearsal.
  void stepTo(double t_s);

  /// Where a mouse begins to move it; none: another device does.
  std::optional<calibration::Pose<calibration::World, calibration::OtherTool>> startOfMouse() const;
  /// Frame W of the first view. Of a mouse alone.
  void moveMouse(const calibration::Pose<calibration::World, calibration::OtherTool>& X_WO);

  /// Gives the renderer the instrument.
  void dress(render::FrameRenderer& renderer) const;
  /// The pose of the instrument and its clear glass; invisible while the device has no valid pose.
  void place(render::Frame& frame);
  /// As placed last, where that is not the same as at the last call: to be recorded.
  std::optional<SecondHandPlace> takeMoved();
  /// A message when tracking is lost, and when it is back.
  std::optional<std::string> takeNews();

 private:
  SecondTool tool_;
  calibration::Pose<calibration::World, calibration::OtherTool> hold_;  ///< scripted
  PoseSource device_;
  std::string name_;
  double rate_Hz_;
  std::unique_ptr<haptics::InstrumentTracker> hand_;  // stops before its device goes
  bool is_seen_ = false, was_seen_ = false, was_lost_ = false;
  SecondHandPlace placed_;
  std::optional<SecondHandPlace> taken_;
};

}  // namespace app
