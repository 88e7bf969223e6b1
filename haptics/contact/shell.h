// Surface points (Petersik et al. 2002, in the limit of many: reference/physics 1.3): bone presses on every patch of
// the bur's surface, F = k_s sum rho n_in dA = -k_s grad V, so it is conservative. Points spread evenly over the
// surface, each weighted by the solid fraction there (a ramp one voxel wide) and its tissue. Flat bone: F = k_s pi h
// (2R - h), steepest at first touch (2 pi k_s R), none at h = R. A flat end or a long side meets flat bone with its
// whole area at once. Frame P; mm, N. Servo thread; cost independent of bur and voxel size.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct ShellParameters {
  double shell_N_per_mm3 = 0.064;  ///< k_s = K / (2 pi R): first touch of a 2 mm ball feels 0.8 N/mm
};

inline constexpr int kShellPoints = 1200;

Contact shellContact(const ShellParameters& parameters, const ToolInBone& at) noexcept;

}  // namespace haptics
