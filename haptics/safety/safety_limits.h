// How much force and torque may reach the hand and how fast they may change. Trivially copyable, part of a Command.
// Defaults: a Touch-class device, 3.3 N peak (reference/physics 4); torque as a Premium 6DOF has it, 188 N mm
// (reference/devices 4.3), as fast as the force at the length of a grip, 50 mm. A device without torque gets none.
// 300 N/s is 0.3 N a tick at 1 kHz, 0.075 at 4 kHz, 0.03 at 10 kHz: one course in time, whatever the rate.
#pragma once

namespace haptics {

struct SafetyLimits {
  double peak_force_N = 3.3;    ///< magnitude clamp
  double slew_N_per_s = 300.0;  ///< largest change of the served force
  double peak_torque_Nmm = 188.0;
  double slew_Nmm_per_s = 15'000.0;
  double most_stiffness_N_per_mm = 20.0;  ///< no contact is steeper: a law beyond it is scaled down to it
};

}  // namespace haptics
