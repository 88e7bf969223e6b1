// Limits of force, torque and their rates, and when there is no force at all. Trivially copyable, part of a Command,
// recorded. Defaults: a Touch-class device, 3.3 N peak (reference/physics 4); torque as a Premium 6DOF, 188 N mm
// (reference/devices 4.3), with the force's rate at the length of a grip, 50 mm. A device without torque gets none. 300
// N/s is 0.3 N a tick at 1 kHz and 0.075 N at 4 kHz. The defaults suit a device that cannot push: for one with motors
// `limitedTo` (servo/haptic_loop) makes them `strict`.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace haptics {

/// Values of reference/devices 6, by its step; not yet tried on a hand.
struct SafetyThresholds {
  double max_pause_s = 0.02;        ///< 3: a longer gap between ticks restarts
  double arming_mm_per_s = 50.0;    ///< 2: the hand may be armed below it
  double release_s = 0.05;          ///< 2: ramp to zero when the deadman detects no hand
  double soft_start_s = 0.5;        ///< 3: from zero to full force …
  double soft_start_N_per_s = 5.0;  ///< 3: … at most at this rate
  double brake_mm_per_s = 600.0;    ///< 6: damping above it …
  double cutoff_mm_per_s = 1000.0;  ///< 6: … and no force above this …
  double cutoff_s = 0.1;            ///< 6: … for this time
  double buzz_mm_per_s = 20.0;      ///< 6: slower reversals do not count
  double stale_s = 0.003;           ///< 9: without a new measurement: as if new, then held …
  double stale_fade_s = 0.005;      ///< 9: … then fading …
  double max_stale_s = 0.02;        ///< 9: … to zero, a fault
  double warm_motor = 0.8;          ///< 7: motor heat from which the force is lowered …
  double share_at_hottest = 0.3;    ///< 7: … down to this share at 1
};

struct SafetyLimits {
  double peak_force_N = 3.3;    ///< magnitude clamp
  double slew_N_per_s = 300.0;  ///< largest change of the commanded force
  double peak_torque_Nmm = 188.0;
  double slew_Nmm_per_s = 15'000.0;
  double max_stiffness_N_per_mm = 20.0;      ///< steeper contacts are scaled down to it
  double max_damping_Ns_per_mm = 0.005;      ///< of the brake
  double continuous_force_N = 1e3;           ///< root mean square over 10 s
  glm::dvec3 peak_joint_torque_Nmm{0.0};     ///< of the motor-driven joints; 0: not limited
  double max_speed_mm_per_s = 100'000.0;     ///< plausible for a hand; a mouse and a script may jump
  double max_angular_speed_rad_per_s = 1e5;  ///< the same
  bool must_be_armed = false;                ///< the device can push: arm first, start softly, latch faults
  SafetyThresholds thresholds{};
};

/// 0 is no limit; an invalid peak becomes the tightest limit.
inline double sanitisedJointPeak_Nmm(double peak_Nmm) {
  return std::isfinite(peak_Nmm) && peak_Nmm >= 0.0 ? peak_Nmm : 1e-9;
}

/// For a device that can push, whatever was requested: armed first, default thresholds, no hand faster than 2 m/s
/// (reference/devices 6.1) or 100 rad/s, rates at most the defaults.
SafetyLimits strict(const SafetyLimits& limits);

/// Valid limits: an invalid peak becomes 0, another invalid value its default.
SafetyLimits sanitised(const SafetyLimits& limits);

}  // namespace haptics
