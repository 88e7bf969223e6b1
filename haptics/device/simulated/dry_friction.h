// A virtual hand on a device with dry (Coulomb) friction: the same force against the motion at every speed, and at rest
// as much as keeps it at rest. Exact between events (stick, slide), whose times are found by bisection: no creep, no
// chatter, for any stiffness and dt. mm, N, s. One thread; at most 24 steps of VirtualHand, under 3 us.
#pragma once

#include "haptics/device/simulated/virtual_hand.h"

namespace haptics {

/// As VirtualHand::advance. The direction of sliding is held for a quarter of `dt_s`.
void advanceWithDryFriction(VirtualHand& hand, double dry_N, const glm::dvec3& target_mm,
                            const glm::dvec3& target_velocity_mm_per_s, const glm::dvec3& force_N, double dt_s);

}  // namespace haptics
