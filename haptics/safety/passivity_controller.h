// Time-domain passivity observer and controller (Hannaford & Ryu, IEEE T-RA 18(1), 2002; reference/devices 6):
// withholds the force along the motion that would give the hand more energy than it has put in; never pushes against
// the hand.
//   E <- E - (F_last + F)/2 . dx    observed work by the midpoint rule, so a conservative law is left exactly alone
//   E <= what a spring of this contact could store; 0 in air: dissipated energy is no credit for later activity
//   along the motion  f <= f_max,  f_max |dx| + f_max^2 |dx| / (2 slew dt) = E + tolerance
// the work of this tick and of the ramp down at the slew limit; up to slew/k of speed (375 mm/s at 0.8 N/mm) a linear
// spring pays for it. The hand gets at most the tolerance, the midpoint rule's error at first touch, and what a jerk
// takes during the ramp, F^2 v / (2 slew): under 0.05 N mm in steady contact (tests). Not covered: the energy leak of
// sampling (K T/2, damped by the device, reference/physics 2.5) and vibration. Frame P, about the handle. Servo thread;
// flops.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/wrench.h"

namespace haptics {

class PassivityController {
 public:
  static constexpr double kTolerance_Nmm = 0.005;        ///< k v^2 T^2 / 8 at 0.8 N/mm, 0.2 m/s, 1 kHz
  static constexpr double kReleaseDebt_Nmm = 0.5;        ///< beyond it the force is released at once
  static constexpr double kRetainedDebt_Nmm = 1.0;       ///< debt beyond it decays over 1 s
  static constexpr double kMaxDebt_Nmm = 10.0;           ///< bound for the worst hand and law, see maxForce_N
  static constexpr double kMaxSpeed_mm_per_s = 2'000.0;  ///< of a hand (safety/hand_guard)
  static constexpr double kLever_mm = 50.0;              ///< rotation weighs as this travel per rad

  /// Of the handle in this tick: travel, and a small rotation (rad).
  struct Motion {
    calibration::Vector<calibration::Patient> travel_P_mm, rotation_P_rad;
  };

  /// `requested` without the part that would overdraw the energy; unchanged, bit for bit, while there is enough.
  Wrench<calibration::Patient> limit(const Wrench<calibration::Patient>& requested, const Motion& motion,
                                     double slew_N_per_s, double dt_s) const noexcept;

  /// The debt after this motion is too large for a ramp.
  bool isOverdrawn(const Motion& motion) const noexcept { return balance_Nmm(motion) < -kReleaseDebt_Nmm; }
  /// Bound that keeps the debt within kMaxDebt for any next move of at most m = kMaxSpeed dt:
  ///   |F| <= 2 (E + kMaxDebt) / (|dx| + m)      10 N at 1 kHz, 5 N at 500 Hz without debt
  /// Torque weighs as force at kLever.
  double maxForce_N(const Motion& motion, double dt_s) const noexcept;

  /// Observes the commanded wrench. `max_stored_Nmm`: what the contact could store, 0 in air.
  void observe(const Wrench<calibration::Patient>& commanded, const Motion& motion, double max_stored_Nmm,
               double dt_s) noexcept;

  /// Energy the hand has put in and may get back; below 0 it got too much.
  double energy_Nmm() const { return energy_Nmm_; }

 private:
  /// Including the work of the last wrench in this motion.
  double balance_Nmm(const Motion& motion) const noexcept;

  Wrench<calibration::Patient> last_;
  double energy_Nmm_ = 0.0;
};

}  // namespace haptics
