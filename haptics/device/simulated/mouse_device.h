// The mouse as a haptic device: the window says where the hand wants to be, a virtual hand goes there smoothly, and the
// force pushes it softly back. Frame D. setTarget(): one UI thread; exchange(): the servo thread; they meet in a
// Latest. No allocation after construction. Not a force display: nobody feels it but the picture shows it.
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

  /// UI thread. A target that is not finite is ignored.
  void setTarget(const MouseTarget& target);

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  Latest<MouseTarget> target_;
  VirtualHand hand_;
  glm::dquat rotation_;
  DeviceCapabilities capabilities_;
};

}  // namespace haptics
