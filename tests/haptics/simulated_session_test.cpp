#include <gtest/gtest.h>

#include "haptics/device/simulated/work_cycle.h"
#include "haptics/servo/haptic_loop.h"
#include "tests/haptics/held_phantom.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

/// A short trough across the top of the bone, from above.
WorkCycle shortRound(const PhantomMechanics& mechanics) {
  assets::StraightCut cut;
  cut.outward_P = {0.0, 0.0, 1.0};
  cut.lateral_P = {0.0, 1.0, 0.0};
  cut.length_mm = 6.0;
  cut.depth_mm = 1.0;
  const auto rest_DH = mechanics.rest_DH();
  const HandTarget rest{rest_DH.translation_mm, rest_DH.rotation, false, 0, true};
  return {
      TroughPath(assets::plannedAlong(cut), {.speed_mm_per_s = 20.0}), rest, {{0.0, -66.0, 30.0}, {0.0, 0.0, 40.0}}};
}

TEST(SimulatedSession, ArmsOnItsWayCarvesAndEndsWithoutForce) {
  for (const PhantomMechanics& mechanics : simulatedPhantoms()) {
    SCOPED_TRACE(mechanics.key);
    const WorkCycle round = shortRound(mechanics);
    const HandScript script = [&](double t_s) { return round.at(t_s); };
    const Command command = limitedTo(SimulatedPhantom(mechanics, script).capabilities(), 1000.0, {});
    HeldPhantom session(mechanics, script, {}, halfSpace(7.0, 0.25).bodies(1), command);

    double removed_mm3 = 0.0, most_N = 0.0, contact_s = 0.0;
    bool was_active = false, felt_early = false;
    Tick tick;
    while (tick.t_s < round.duration_s()) {
      tick = session.step(1e-3);
      const double force_N = glm::length(tick.commanded_force_P_N.xyz);
      ASSERT_NE(tick.state, SafetyState::fault) << tick.t_s << " s";
      ASSERT_TRUE(force_N == 0.0 || tick.state == SafetyState::active) << tick.t_s << " s";
      was_active = was_active || tick.state == SafetyState::active;
      felt_early = felt_early || (tick.overlap_mm3 > 0.0 && !was_active);
      removed_mm3 += tick.removed_mm3;
      most_N = std::max(most_N, force_N);
      contact_s += tick.depth_mm > 0.0 ? 1e-3 : 0.0;
    }
    EXPECT_TRUE(was_active);
    EXPECT_FALSE(felt_early) << "armed before it touches";
    EXPECT_GT(removed_mm3, 2.0);
    EXPECT_GT(contact_s, 1.0);
    EXPECT_GT(most_N, 0.1);
    EXPECT_LE(most_N, mechanics.peak_force_N);
    EXPECT_EQ(tick.commanded_force_P_N.xyz, glm::dvec3(0.0));
    // Nothing can push in the inkwell, nor where a switch feels that the handle was let go of.
    EXPECT_EQ(tick.state == SafetyState::ready, mechanics.has_inkwell);
    EXPECT_EQ(tick.state == SafetyState::active, !mechanics.has_inkwell && !mechanics.has_deadman);
  }
}

}  // namespace
}  // namespace haptics
