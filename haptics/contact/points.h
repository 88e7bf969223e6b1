// Volumetric sample points (Gajananan; Morris et al. 2006; reference/physics 1.4): the share u of points inside the bur
// that lie in bone gives the depth, d = d0 u^(1/m) with m by shape and attitude, so that flat bone feels linear; the
// positions of the points give the direction, by a rule for each shape; the mean density over the last 100 ticks gives
// the stiffness:  F = k rho d n.  The window is on the density alone: on the force it would be a delay of 50 ms and
// unstable (reference/physics 0.4). Frame P; mm, N. Servo thread; fixed number of points.
#pragma once

#include "haptics/contact/contact.h"
#include "haptics/contact/law_state.h"

namespace haptics {

struct PointsParameters {
  double stiffness_N_per_mm = 0.8;  ///< k of cortical bone
};

inline constexpr int kSamplePoints = 2048;

Contact pointsContact(const PointsParameters& parameters, const ToolInBone& at, const LawState& state) noexcept;

/// Adds the density of the last evaluation of a tick to the window.
void updatePointsState(const Contact& contact, LawState& state) noexcept;

}  // namespace haptics
