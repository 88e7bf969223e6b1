// Measures of one probing of a bone: stiffness, peak force, work. Depth is that of the hand below the position of first
// contact, along the outward direction; force is that on the hand, outward. mm, N. Pure; any thread; linear in the
// samples.
#pragma once

#include <span>

namespace app {

struct ProbeSample {
  double depth_mm = 0.0;
  double force_N = 0.0;
};

struct ProbeMeasures {
  double stiffness_N_per_mm = 0.0;  ///< least-squares slope of force over depth while in contact
  double peak_force_N = 0.0;
  double depth_mm = 0.0;  ///< largest
  double work_Nmm = 0.0;  ///< done by the hand on the bone: sum of F dx over the path
  double contact_share = 0.0;
};

/// In contact: more than a twentieth of the peak force. All zero without contact.
ProbeMeasures measuresOf(std::span<const ProbeSample> samples);

}  // namespace app
