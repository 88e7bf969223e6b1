// What the motors of a device do until the next command: force and torque on the hand, frame D, torque about the origin
// of H; N, N mm. Only the motor gate (safety/motor_gate) makes one with force; anyone may make one without, or scale
// one down. Trivially copyable; any thread.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/wrench.h"

namespace haptics {

class MotorCommand {
 public:
  /// No force, motors off.
  constexpr MotorCommand() = default;

  const Wrench<calibration::Device>& wrench_D() const { return wrench_D_; }
  bool motorsOn() const { return motors_on_; }

  /// Scaled by `share`, 0 to 1; anything else counts as 0.
  MotorCommand scaled(double share) const {
    return {(share >= 0.0 && share <= 1.0 ? share : 0.0) * wrench_D_, motors_on_};
  }

 private:
  friend class MotorGate;
  constexpr MotorCommand(const Wrench<calibration::Device>& wrench_D, bool motors_on)
      : wrench_D_(wrench_D), motors_on_(motors_on) {}

  Wrench<calibration::Device> wrench_D_;
  bool motors_on_ = false;
};

}  // namespace haptics
