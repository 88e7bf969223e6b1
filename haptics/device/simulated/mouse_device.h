// The mouse as a haptic device: the window sets a target pose, a virtual hand moves there smoothly, and the contact
// force displaces it visibly. Frame D, mm. setTarget(): one UI thread; exchange(): the thread of the ticks; they share
// a Latest. No allocation after construction. The smallest complete device: the one to copy for a new driver.
#pragma once

#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/device/simulated_device.h"
#include "haptics/latest.h"

namespace haptics {

struct MouseTarget {
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;
  bool pedal = false;
};

class MouseDevice final : public SimulatedDevice {
 public:
  explicit MouseDevice(const MouseTarget& start = {});
  ~MouseDevice() override { stop(); }

  /// Before the first exchange: the hand is there at once. A target that is not finite is ignored.
  void placeAt(const MouseTarget& target);

  /// UI thread. A target that is not finite is ignored.
  void setTarget(const MouseTarget& target);

  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  Latest<MouseTarget> target_;
  VirtualHand hand_;
  glm::dquat rotation_;
};

}  // namespace haptics
