// Keeps books on the energy between tool and hand, and withholds force that would give more of it than the hand has put
// in (time-domain passivity: Hannaford & Ryu, IEEE T-RA 18(1), 2002; reference/devices 6). What is withheld is part of
// the force along the motion, never more than all of it: it never pushes against the hand.
//   E <- E - (w_last + w)/2 . dx    work by the midpoint rule, so a conservative law is left exactly alone
//   E <= what a spring of this contact could hold; 0 in air: what was dissipated is no credit for later activity
//   along the motion  f <= f_max,  f_max |dx| + f_max^2 |dx| / (2 slew dt) = E + grace
// That is what flows in this tick and while the force comes down at the slew limit, so it comes down in time and
// without a step; up to slew/k of speed (375 mm/s at 0.8 N/mm) a linear spring pays for it. In all the hand gets no
// more than the grace, which is the midpoint rule's own error at first touch, and what a hand that jerks back takes
// while the force comes down, F^2 v / (2 slew): under 0.05 N mm in steady contact (tests). Besides, a hand that has had
// kLetDown is let go of at once, and maxForce_N bounds what the worst of hands and laws can take.
// Not the energy that sampling and holding the force leaks (K T/2: the device's own damping takes it, physics 2.5), and
// not the tool's vibration.
// Frame P, about the handle; rotation weighs as kLever_mm of travel. Servo thread; flops.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/wrench.h"

namespace haptics {

class PassivityController {
 public:
  static constexpr double kTolerance_Nmm = 0.005;  ///< k v^2 T^2 / 8 at 0.8 N/mm, 0.2 m/s, 1 kHz; 0.6 N mm press 1 N
  static constexpr double kReleaseDebt_Nmm = 0.5, kRetainedDebt_Nmm = 1.0, kMaxDebt_Nmm = 10.0;
  static constexpr double kMaxSpeed_mm_per_s = 2'000.0;  ///< of a hand (safety/hand_guard)
  static constexpr double kLever_mm = 50.0;

  /// Where the handle went in this tick: travel, and a small rotation (rad).
  struct Motion {
    calibration::Vector<calibration::Patient> travel_P_mm, turn_P_rad;
  };

  /// What may be given of `wanted` after this motion. The very same wrench while the books are in order.
  Wrench<calibration::Patient> allow(const Wrench<calibration::Patient>& wanted, const Motion& motion,
                                     double slew_N_per_s, double dt_s) const noexcept;

  /// After this motion the debt is too large to let the force down gently.
  bool isOverdrawn(const Motion& motion) const noexcept { return balance_Nmm(motion) < -kReleaseDebt_Nmm; }
  /// Whatever the next move of the tick, of at most m = kFastest dt, the debt stays within kMostDebt:
  ///   |F| <= 2 (E + kMostDebt) / (|dx| + m)      10 N at 1 kHz, 5 N at 500 Hz while the books are in order
  /// Torque weighs as force at kLever. Beyond kForgiven the debt is forgiven over 1 s, so that a force comes back.
  double maxForce_N(const Motion& motion, double dt_s) const noexcept;

  /// Enters what was given in the end. `max_stored_Nmm`: what the contact could hold now, 0 in air.
  void enter(const Wrench<calibration::Patient>& given, const Motion& motion, double max_stored_Nmm,
             double dt_s) noexcept;

  /// What the hand has put in and may have back; below 0 it has had too much.
  double energy_Nmm() const { return energy_Nmm_; }

 private:
  /// With what the last wrench did in this motion.
  double balance_Nmm(const Motion& motion) const noexcept;

  Wrench<calibration::Patient> last_;
  double energy_Nmm_ = 0.0;
};

}  // namespace haptics
