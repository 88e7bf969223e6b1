// A haptic device that exists in numbers only, in the hand of somebody who follows a path: a mass with friction, held
// by a grip of a given impedance, its encoders as coarse as told, its motors as strong. What a controller has to be
// stable with, so it buzzes where a real one would: K > 2 b / T (reference/physics 2.5: 4.01 N/mm at 1 kHz with the
// defaults and no grip). Frame D, mm, N, s; exact for a force held from tick to tick. Servo thread; no allocation after
// construction. Not the arm's kinematics, not its structural modes.
#pragma once

#include "haptics/device/simulated/device_in_numbers.h"
#include "haptics/device/simulated/trough_path.h"
#include "haptics/device/simulated/virtual_hand.h"

namespace haptics {

struct SimulatedMechanics {
  double mass_kg = 0.1;               ///< of device and fingers (reference/physics 2.5)
  double friction_Ns_per_mm = 0.002;  ///< of the device, viscous
  double grip_N_per_mm = 0.3;         ///< a light grip; 0: let go of
  double grip_Ns_per_mm = 0.003;
  double resolution_mm = 0.0;  ///< of its encoders, along D's axes; 0: perfect
  double peak_force_N = 3.3;   ///< its motors give no more
  double peak_torque_Nmm = 0.0;
};

/// The machine and the grip on it.
class SimulatedMachine {
 public:
  /// Throws DeviceError when a number is not finite, the mass not positive or another number negative.
  SimulatedMachine(const SimulatedMechanics& mechanics, const HandTarget& start);

  DeviceCapabilities capabilities() const;
  /// Moves for `dt_s` while the hand goes from one target to the next.
  HandleState move(const HandTarget& from, const HandTarget& to, const Wrench<calibration::Device>& wrench_D,
                   double dt_s) noexcept;

 private:
  SimulatedMechanics mechanics_;
  VirtualHand hand_;
};

/// The machine in the hand of a surgeon who cuts a trough.
class SimulatedDevice final : public DeviceInNumbers {
 public:
  /// Throws DeviceError when plan or mechanics are not usable.
  SimulatedDevice(const TroughPlan& plan, const SimulatedMechanics& mechanics)
      : path_(plan), machine_(mechanics, path_.at(0.0)), capabilities_(machine_.capabilities()) {}
  ~SimulatedDevice() override { stop(); }

  double duration_s() const { return path_.duration_s(); }

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  TroughPath path_;
  SimulatedMachine machine_;
  DeviceCapabilities capabilities_;
  double t_s_ = 0.0;
};

}  // namespace haptics
