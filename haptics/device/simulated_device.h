// A device that exists in numbers only: what its motors were told last acts while the next state is made. exchange() is
// the device's thread's, or whoever steps it without one; bounded, no allocation. Started by hand it needs neither
// thread nor clock: its time is the ticks it is told to make.
#pragma once

#include "haptics/device/paced_device.h"

namespace haptics {

class SimulatedDevice : public PacedDevice {
 public:
  /// Serves a wrench on the hand for `dt_s`, torque about the origin of H, and returns where the hand then is.
  virtual HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept = 0;

  using PacedDevice::pass;
  using PacedDevice::startStepped;
  using PacedDevice::step;
  using PacedDevice::steppedTime_ns;

 protected:
  HandleState sense(double dt_s) noexcept override { return exchange(command_.wrench_D(), dt_s); }
  void drive(const MotorCommand& command) noexcept override { command_ = command; }

 private:
  MotorCommand command_;
};

}  // namespace haptics
