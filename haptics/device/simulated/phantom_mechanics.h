// The parameters of a Phantom as a machine: geometry, sensors, mass, friction, motors, inkwell. Source:
// reference/devices 4.3 unless noted; (assumed) where nothing is published. mm, N, N mm, s, kg. Plain data; any thread.
#pragma once

#include <array>
#include <string_view>

#include "calibration/arm/phantom_kinematics.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/simulated/phantom_sensors.h"

namespace haptics {

struct PhantomMechanics {
  std::string_view key;   ///< on the command line, after "simulated:"
  std::string_view name;  ///< for people
  calibration::PhantomGeometry geometry;
  PhantomSensing sensing;

  double mass_kg = 0.0;             ///< apparent, at the handle, in every direction
  double viscous_Ns_per_mm = 0.0;   ///< (assumed) 0.5 N s/m: allows the stiffness CHAI3D recommends, K < 2 b / T
  double dry_N = 0.0;               ///< backdrive friction
  int latency_ticks = 0;            ///< from command to force; (assumed) 1 with a bus
  double peak_force_N = 0.0;        ///< of the motors, in every direction …
  double peak_joint_Nmm = 0.0;      ///< … and of each of them
  double continuous_force_N = 0.0;  ///< without a time limit; joint torques in the same proportion
  double heat_time_s = 30.0;        ///< (assumed)

  calibration::Point<calibration::Device> rest_D;  ///< where its handle lies when not in use …
  bool has_inkwell = false;                        ///< … in an inkwell
  bool has_deadman = false;                        ///< senses a hand on the handle
  double max_stiffness_N_per_mm = 0.0, max_damping_Ns_per_mm = 0.0;
  WorkspaceBox workspace;

  /// The handle at rest, its gimbal at zero.
  calibration::Pose<calibration::Device, calibration::Handle> rest_DH() const;
};

/// omni, touch, desktop, premium.
const std::array<PhantomMechanics, 4>& simulatedPhantoms();
/// Null: none of this key.
const PhantomMechanics* findSimulatedPhantom(std::string_view key);

}  // namespace haptics
