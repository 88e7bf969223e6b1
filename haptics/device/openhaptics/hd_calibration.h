// Keeps a device calibrated by its style (reference/devices 2): automatically, by its inkwell, or by a reset of its
// encoders in a known position, which only a person can see. update(): inside a frame, on the scheduler's thread, one
// or two library calls ten times a second, every tick while the pose is not valid. The others: any thread. Not the
// calibration of the rig.
#pragma once

#include <atomic>
#include <string>

#include "haptics/device/openhaptics/hd_library.h"

namespace haptics {

class HdCalibration {
 public:
  /// `styles`: the bits of the device's style.
  explicit HdCalibration(hd::Enum styles) : styles_(styles) {}

  /// Whether the pose of this frame is valid.
  bool update(const HdFunctions& hd, double rate_Hz) noexcept;

  /// The arm is in its reset position now; for a device that is calibrated that way.
  void resetHere() { reset_requested_.store(true); }

  /// What the user has to do, one sentence; empty: nothing.
  std::string requiredAction() const;

 private:
  hd::Enum updateStyle() noexcept;

  hd::Enum styles_;
  std::atomic<hd::Enum> state_{hd::kCalibrationNeedsUpdate};
  std::atomic<bool> reset_requested_{false};
  int ticks_to_check_ = 0;
};

}  // namespace haptics
