// A simulated Phantom and the servo, stepped without a thread; the device's frame is the patient's, handle and tool
// coincide.
#pragma once

#include <utility>

#include "haptics/device/simulated/simulated_phantom.h"
#include "haptics/servo/servo.h"

namespace haptics {

class HeldPhantom {
 public:
  HeldPhantom(const PhantomMechanics& mechanics, const HandScript& script, const Grip& grip, Bodies bone,
              const Command& command)
      : bone_(std::move(bone)), servo_(bone_), device_(mechanics, script, grip), command_(command) {}

  Tick step(double dt_s) {
    const HandleState state = device_.exchange(told_, dt_s);
    HandSample hand;
    hand.X_PT = {state.X_DH.rotation, state.X_DH.translation_mm};
    hand.velocity_P_mm_per_s.xyz = hand.handle_velocity_P_mm_per_s.xyz = state.velocity_D_mm_per_s.xyz;
    hand.jacobian_P_mm = state.jacobian_D_mm;
    hand.motor_heat = state.motor_heat;
    hand.drill_pedal = state.pedal;
    hand.docked = state.docked;
    hand.held = state.held;
    hand.calibrated = state.calibrated;
    const Tick felt = servo_.step(hand, command_, dt_s);
    told_.force_N.xyz = felt.commanded_force_P_N.xyz;
    return felt;
  }
  const SimulatedPhantom& device() const { return device_; }
  glm::dvec3 velocity_mm_per_s() const { return device_.velocity_D_mm_per_s().xyz; }

 private:
  Bodies bone_;
  Servo servo_;
  SimulatedPhantom device_;
  Command command_;
  Wrench<calibration::Device> told_;
};

}  // namespace haptics
