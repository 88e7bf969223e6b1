// The bend of one joint of a file: energy of the angle between two links, and what Newton needs of it. Linear, or with
// a plateau: M = K phi (p + (1 - p) / sqrt(1 + (phi/y)^2)), smooth and growing. On the sphere of directions the
// energy's slope along e is -f1 (e . a), its curvature f1 cos + f2 a a' (reference/sisters 1.2), where f1 = M / sin and
// f2 = (M' - M cos/sin) / sin^2. Arc sine from its series: the same bits with any mathematics library. N mm, rad.
// Any thread; 20 ns.
#pragma once

#include <cmath>

namespace haptics {

struct JointStiffness {
  double stiffness_Nmm_per_rad = 0.0;
  double plateau_rad = 0.0;  ///< y; 0: linear
  double plateau_share = 1.0;

  /// M / phi and M' at an angle squared.
  double secant(double angle2) const {
    if (plateau_rad <= 0.0) return stiffness_Nmm_per_rad;
    return stiffness_Nmm_per_rad *
           (plateau_share + (1.0 - plateau_share) / std::sqrt(1.0 + angle2 / (plateau_rad * plateau_rad)));
  }
};

/// Of the sine 0 to 1; relative error below 1e-12.
inline double angleOfSine(double sine) noexcept {
  double doubled = 1.0;
  while (sine > 0.05) {
    const double rest = 1.0 - sine * sine;
    sine /= std::sqrt(2.0 * (1.0 + std::sqrt(rest > 0.0 ? rest : 0.0)));
    doubled *= 2.0;
  }
  const double s2 = sine * sine;
  return doubled * sine * (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (15.0 / 336.0 + s2 * (105.0 / 3456.0)))));
}

struct JointBend {
  double angle_rad, energy_Nmm, moment_Nmm, f1, f2;
};

/// `chord` is the length of the difference of the two unit directions.
inline JointBend jointBend(const JointStiffness& joint, double chord) noexcept {
  const double half_sine = chord < 2.0 ? 0.5 * chord : 1.0, half_sine2 = half_sine * half_sine;
  const double angle = 2.0 * angleOfSine(half_sine), angle2 = angle * angle;
  const double cosine = 1.0 - 2.0 * half_sine2;
  const double sine = std::fmax(2.0 * half_sine * std::sqrt(1.0 - half_sine2), angle > 1.0 ? 1e-2 : 0.0);
  const double over_sine = angle < 1e-4 ? 1.0 + angle2 / 6.0 : angle / sine, over_sine2 = over_sine * over_sine;
  const double secant = joint.secant(angle2);
  const double flat = angle < 0.03 ? 1.0 / 3.0 + angle2 * (2.0 / 15.0) : (1.0 - angle * cosine / sine) / (sine * sine);

  JointBend bend{angle, 0.5 * joint.stiffness_Nmm_per_rad * angle2, secant * angle, secant * over_sine, secant * flat};
  if (joint.plateau_rad > 0.0) {
    const double y2 = joint.plateau_rad * joint.plateau_rad,
                 given = joint.stiffness_Nmm_per_rad * (1.0 - joint.plateau_share);
    const double root = std::sqrt(1.0 + angle2 / y2);
    // y^2 (root - 1) without a difference of near numbers.
    bend.energy_Nmm = 0.5 * joint.stiffness_Nmm_per_rad * joint.plateau_share * angle2 + given * angle2 / (root + 1.0);
    bend.f2 -= given / (y2 * root * root * root) * over_sine2;
  }
  return bend;
}

}  // namespace haptics
