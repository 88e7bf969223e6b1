// A simulated Phantom in a hand that follows a script and is moved by its forces: the arm's kinematics,
// mass and friction, motors with limits, delay and heat, stops, inkwell, encoders, gimbal noise. Servo and safety are
// tested with it. Frame D; mm, N, s. The device's thread; a pure function of the steps and the seed; about 1.5 us a
// tick, no allocation after construction. Its mass is the same in every direction; no gravity, no bending of the links,
// no torque on the handle. An untrue arm affects its sensors only, not the direction of its motor forces.
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

/// Properties of one unit.
struct PhantomUnit {
  std::string serial;
  std::optional<calibration::PerturbedArm> untrue;  ///< none: exactly its model
};

class SimulatedPhantom final : public SimulatedDevice {
 public:
  static constexpr int kMaxLatency_ticks = 15;

  /// Throws DeviceError when a parameter is out of range, or the script starts beyond the arm's reach.
  SimulatedPhantom(const PhantomMechanics& mechanics, HandScript script, const Grip& grip = {}, std::uint32_t seed = 1,
                   const PhantomUnit& unit = {});
  ~SimulatedPhantom() override { stop(); }

  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

  /// The true angles, not those of the sensors.
  const calibration::PhantomJoints& joints() const { return joints_; }
  calibration::Vector<calibration::Device> velocity_D_mm_per_s() const { return {handle_.velocity_mm_per_s}; }
  /// Of the motors on the hand in the last step.
  calibration::Vector<calibration::Device> pushed_D_N() const { return {pushed_N_}; }

 private:
  glm::dvec3 motorForce_N(const glm::dvec3& requested_N, double dt_s) noexcept;
  void move(const HandTarget& from, const HandTarget& to, double dt_s) noexcept;
  void rotate(const HandTarget& to) noexcept;
  void dock(const HandTarget& to) noexcept;

  PhantomMechanics mechanics_;
  SimulatedHand hand_;
  VirtualHand handle_;
  PhantomSensors sensors_;
  MotorHeat heat_;
  calibration::PhantomJoints joints_;
  glm::dvec3 rest_rad_{0.0};
  std::array<glm::dvec3, kMaxLatency_ticks + 1> delayed_N_{};
  std::size_t tick_ = 0;
  glm::dvec3 pushed_N_{0.0};
  double t_s_ = 0.0;
  bool docked_ = false, calibrated_ = false;
};

}  // namespace haptics
