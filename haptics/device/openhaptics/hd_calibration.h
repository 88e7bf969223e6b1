// Keeps a device calibrated as its style asks (reference/devices 2): automatically, by its inkwell, or by a reset of
// its encoders in a known position that only a person can see. update(): inside a frame, on the scheduler's thread, one
// or two calls of the library ten times a second, every tick while the pose can not be believed. Everything else: any
// thread. Not the calibration of the rig.
#pragma once

#include <atomic>
#include <string>

#include "haptics/device/openhaptics/hd_library.h"

namespace haptics {

class HdCalibration {
 public:
  /// `styles`: the bits of the device's style.
  explicit HdCalibration(hd::Enum styles) : styles_(styles) {}

  /// Whether the pose of this frame can be believed.
  bool update(const HdFunctions& hd, double rate_Hz) noexcept;

  /// The arm is in its reset position now, somebody says; for a device that is calibrated that way.
  void resetHere() { reset_asked_.store(true); }

  /// What a person has to do, one sentence; empty: nothing.
  std::string requiredAction() const;

 private:
  hd::Enum updateStyle() noexcept;

  hd::Enum styles_;
  std::atomic<hd::Enum> state_{hd::kCalibrationNeedsUpdate};
  std::atomic<bool> reset_asked_{false};
  int ticks_to_check_ = 0;
};

}  // namespace haptics
