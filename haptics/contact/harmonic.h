// The harmonic bur: bone at distance r < R from the bur's centre repels it as a charge does, U = sum rho k / (2 pi r)
// (reference/physics 2.7, 2.8). Flat bone then gives F = k h exactly in any orientation for 0 <= h <= R, and the force
// is the gradient of a potential: no closed path gives energy to the hand. Spheres only. Frame P; mm, N. Servo thread.
#pragma once

namespace haptics {

struct HarmonicParameters {
  double stiffness_N_per_mm = 0.8;  ///< k of cortical bone: dF/dh from first touch to h = R
};

}  // namespace haptics
