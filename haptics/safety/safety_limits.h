// How much force and torque may reach the hand, how fast they may change, and when there is none at all. Trivially
// copyable, part of a Command, recorded. Defaults: a Touch-class device, 3.3 N peak (reference/physics 4); torque as a
// Premium 6DOF has it, 188 N mm (reference/devices 4.3), as fast as the force at the length of a grip, 50 mm. A device
// without torque gets none. 300 N/s is 0.3 N a tick at 1 kHz, 0.075 at 4 kHz: one course in time, whatever the rate.
// As they stand nobody can be pushed: for a device with motors `limitedTo` (servo/haptic_loop) makes them `strict`.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace haptics {

/// Starting values of reference/devices 6, by its step; none was tried on a hand yet.
struct SafetyThresholds {
  double max_pause_s = 0.02;        ///< 3: a longer gap between ticks begins anew
  double arming_mm_per_s = 50.0;    ///< 2: slower than this the hand may be armed
  double release_s = 0.05;          ///< 2: to no force when the deadman feels no hand
  double soft_start_s = 0.5;        ///< 3: from no force to all of it …
  double soft_start_N_per_s = 5.0;  ///< 3: … and no faster than this
  double brake_mm_per_s = 600.0;    ///< 6: beyond it the motion is damped …
  double cutoff_mm_per_s = 1000.0;  ///< 6: … and beyond this there is no force …
  double cutoff_s = 0.1;            ///< 6: … for so long
  double buzz_mm_per_s = 20.0;      ///< 6: slower shaking does not count
  double stale_s = 0.003;           ///< 9: without a new measurement: as if it were new, then held …
  double stale_fade_s = 0.005;      ///< 9: … then fading …
  double max_stale_s = 0.02;        ///< 9: … and gone, a fault
  double warm_motor = 0.8;          ///< 7: of motor heat: from here on less force …
  double share_at_hottest = 0.3;    ///< 7: … down to this share at 1
};

struct SafetyLimits {
  double peak_force_N = 3.3;    ///< magnitude clamp
  double slew_N_per_s = 300.0;  ///< largest change of the served force
  double peak_torque_Nmm = 188.0;
  double slew_Nmm_per_s = 15'000.0;
  double max_stiffness_N_per_mm = 20.0;      ///< no contact is steeper: a law beyond it is scaled down to it
  double max_damping_Ns_per_mm = 0.005;      ///< of a hand that is too fast
  double continuous_force_N = 1e3;           ///< root mean square over 10 s; beyond the peak it never binds
  glm::dvec3 peak_joint_torque_Nmm{0.0};     ///< of the motor-driven joints; 0: not limited
  double max_speed_mm_per_s = 100'000.0;     ///< what moves faster is no hand; a mouse and a script may jump
  double max_angular_speed_rad_per_s = 1e5;  ///< the same
  bool must_be_armed = false;                ///< somebody can be pushed: arm first, start softly, latch faults
  SafetyThresholds thresholds{};
};

/// A joint's peak torque as it is obeyed: 0 is no limit, and one that can not be read is the tightest there is.
inline double sanitisedJointPeak_Nmm(double peak_Nmm) {
  return std::isfinite(peak_Nmm) && peak_Nmm >= 0.0 ? peak_Nmm : 1e-9;
}

/// As they must be where somebody can be pushed, whatever was asked for: armed first, the thresholds as they stand, no
/// hand faster than 2 m/s (reference/devices 6.1) or 100 rad/s, no force that changes faster than by default.
SafetyLimits strict(const SafetyLimits& limits);

/// The limits as they are obeyed: a peak that is not a number >= 0 means nothing at all, another unusable number the
/// default.
SafetyLimits sanitised(const SafetyLimits& limits);

}  // namespace haptics
