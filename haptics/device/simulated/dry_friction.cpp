#include "haptics/device/simulated/dry_friction.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr int kPieces = 4, kMostEvents = 12, kHalvings = 12;

/// A target that moves steadily, and the push of the motors.
struct Pull {
  glm::dvec3 target_mm, velocity_mm_per_s, force_N;

  glm::dvec3 targetAfter(double t_s) const { return target_mm + velocity_mm_per_s * t_s; }
  /// On a hand at rest.
  glm::dvec3 onResting_N(const VirtualHand& hand, double t_s) const {
    return force_N + hand.stiffness_N_per_mm * (targetAfter(t_s) - hand.position_mm) +
           hand.damping_Ns_per_mm * velocity_mm_per_s;
  }
};

VirtualHand slid(VirtualHand hand, const Pull& pull, const glm::dvec3& friction_N, double from_s, double for_s) {
  hand.advance(pull.targetAfter(from_s), pull.velocity_mm_per_s, pull.force_N + friction_N, for_s);
  return hand;
}

}  // namespace

void advanceWithDryFriction(VirtualHand& hand, double dry_N, const glm::dvec3& target_mm,
                            const glm::dvec3& target_velocity_mm_per_s, const glm::dvec3& force_N, double dt_s) {
  if (!(dry_N > 0.0)) return hand.advance(target_mm, target_velocity_mm_per_s, force_N, dt_s);
  const Pull pull{target_mm, target_velocity_mm_per_s, force_N};
  double t_s = 0.0;
  for (int event = 0; event < kMostEvents && t_s < dt_s; ++event) {
    const double step_s = std::min(dt_s / kPieces, dt_s - t_s);
    const double speed = glm::length(hand.velocity_mm_per_s);
    glm::dvec3 along = hand.velocity_mm_per_s;
    if (speed == 0.0) {
      // At rest it stays while friction can hold it.
      along = pull.onResting_N(hand, t_s);
      if (!(glm::length(along) > dry_N)) {
        t_s += step_s;
        continue;
      }
    }
    const glm::dvec3 friction_N = -dry_N / glm::length(along) * along;
    const VirtualHand whole = slid(hand, pull, friction_N, t_s, step_s);
    if (glm::dot(whole.velocity_mm_per_s, friction_N) <= 0.0) {
      hand = whole;
      t_s += step_s;
      continue;
    }
    // It comes to rest on the way.
    double before_s = 0.0, after_s = step_s;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle_s = 0.5 * (before_s + after_s);
      const bool still_slides =
          glm::dot(slid(hand, pull, friction_N, t_s, middle_s).velocity_mm_per_s, friction_N) <= 0.0;
      (still_slides ? before_s : after_s) = middle_s;
    }
    hand = slid(hand, pull, friction_N, t_s, after_s);
    hand.velocity_mm_per_s = glm::dvec3(0.0);
    t_s += after_s;
  }
}

}  // namespace haptics
