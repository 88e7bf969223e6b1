// Base of the devices without hardware: the motor command of one tick acts while the next state is computed. Ticks come
// from the device's own thread, or from step() on the caller's, without thread and clock. exchange(): the thread of the
// ticks; bounded, no allocation. A subclass calls stop() in its own destructor.
#pragma once

#include "haptics/device/paced_device.h"

namespace haptics {

class SimulatedDevice : public PacedDevice {
 public:
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  /// Applies a wrench to the hand for `dt_s`, torque about the origin of H, and returns the state after it.
  virtual HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept = 0;

  using PacedDevice::pass;
  using PacedDevice::startStepped;
  using PacedDevice::step;
  using PacedDevice::steppedTime_ns;

 protected:
  HandleState sense(double dt_s) noexcept override { return exchange(command_.wrench_D(), dt_s); }
  void drive(const MotorCommand& command) noexcept override { command_ = command; }

  DeviceCapabilities capabilities_;

 private:
  MotorCommand command_;
};

}  // namespace haptics
