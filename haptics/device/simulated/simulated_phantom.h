// A Phantom that exists in numbers only, in the hand of somebody who follows a script and whom its forces really push:
// the arm's kinematics, weight and friction, motors with their limits, delay and warmth, stops, inkwell, encoders,
// gimbal noise. What servo and safety have to be right with. Frame D; mm, N, s. The device's thread; a pure function of
// the steps and the seed; about 1.5 us a tick, no allocation after construction. Its weight is the same in every
// direction; no gravity, no bending of the links, no torque on the handle. An untrue arm shows in what its sensors
// read; its motors push as they are asked.
#pragma once

#include <optional>
#include <string>

#include "haptics/device/simulated/motor_heat.h"
#include "haptics/device/simulated/phantom_mechanics.h"
#include "haptics/device/simulated/phantom_sensors.h"
#include "haptics/device/simulated/simulated_hand.h"
#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/device/simulated_device.h"

namespace haptics {

/// What one unit has of its own.
struct PhantomUnit {
  std::string serial;
  std::optional<calibration::PerturbedArm> untrue;  ///< none: as its model
};

class SimulatedPhantom final : public SimulatedDevice {
 public:
  static constexpr int kMaxLatency_ticks = 15;

  /// Throws DeviceError when a number can not be, or the script starts where the arm does not reach.
  SimulatedPhantom(const PhantomMechanics& mechanics, HandScript script, const Grip& grip = {}, std::uint32_t seed = 1,
                   const PhantomUnit& unit = {});
  ~SimulatedPhantom() override { stop(); }

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

  /// As it is, not as its sensors have it.
  const calibration::PhantomJoints& joints() const { return joints_; }
  calibration::Vector<calibration::Device> velocity_D_mm_per_s() const { return {handle_.velocity_mm_per_s}; }
  /// Of the motors on the hand in the last step.
  calibration::Vector<calibration::Device> pushed_D_N() const { return {pushed_N_}; }

 private:
  glm::dvec3 forceOfMotors_N(const glm::dvec3& asked_N, double dt_s) noexcept;
  void move(const HandTarget& from, const HandTarget& to, double dt_s) noexcept;
  void turn(const HandTarget& to) noexcept;
  void dock(const HandTarget& to) noexcept;

  PhantomMechanics mechanics_;
  SimulatedHand hand_;
  VirtualHand handle_;
  PhantomSensors sensors_;
  MotorHeat heat_;
  DeviceCapabilities capabilities_;
  calibration::PhantomJoints joints_;
  glm::dvec3 rest_rad_{0.0};
  std::array<glm::dvec3, kMaxLatency_ticks + 1> delayed_N_{};
  std::size_t tick_ = 0;
  glm::dvec3 pushed_N_{0.0};
  double t_s_ = 0.0;
  bool docked_ = false, calibrated_ = false;
};

}  // namespace haptics
