#include "haptics/servo/soft_hold.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "haptics/servo/servo.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using assets::SoftTissue;
using assets::SoftTissueField;
using calibration::Patient;
using calibration::Vector;
using ToolPose = SoftHold::ToolPose;

/// Soft tissue where `distance_mm` is negative, 120 mm around the origin.
template <class Distance>
SoftTissueField fieldOf(Distance&& distance_mm, SoftTissue tissue = SoftTissue::lip) {
  SoftTissueField field;
  field.grid = {glm::ivec3(241, 121, 241), 1.0, glm::dvec3(-120.0, -60.0, -120.0)};
  field.distance.resize(field.grid.voxelCount());
  field.tissue.assign(field.grid.voxelCount(), static_cast<std::uint8_t>(tissue));
  assets::forVoxels(field.grid, [&](glm::ivec3 at, std::size_t voxel) {
    field.distance[voxel] = SoftTissueField::stored(distance_mm(field.grid.centre_P_mm(at)));
  });
  return field;
}

/// All of x > 10 mm: 10 mm beside a tool that stands at the origin along z.
const SoftTissueField& wall() {
  static const SoftTissueField field = fieldOf([](const glm::dvec3& p) { return 10.0 - p.x; });
  return field;
}

/// A lip: a torus around z with a tube of 5 mm, 18 mm from the axis, 35 mm above the bur.
const SoftTissueField& lipRing() {
  static const SoftTissueField field =
      fieldOf([](const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.y) - 18.0, p.z - 35.0) - 5.0; });
  return field;
}

Tool roundBur() {
  Tool tool;
  tool.head.radius_mm = 1.5;
  tool.shaft = standardShaft(tool.head);
  return tool;
}

ToolPose poseAt(const glm::dvec3& p, const glm::dquat& rotation = {1.0, 0.0, 0.0, 0.0}) { return {rotation, p}; }

/// Moves the hand to `to` in steps of 0.2 mm and holds it there.
SoftHold::State led(SoftHold& hold, const SoftTissueField& field, glm::dvec3 from, const glm::dvec3& to,
                    bool turning = false) {
  SoftHold::State state;
  const int steps = static_cast<int>(glm::distance(from, to) / 0.2) + 1;
  for (int n = 0; n <= steps + 200; ++n)
    state = hold.update(&field, roundBur(), poseAt(glm::mix(from, to, std::min(1.0, n / double(steps)))), {}, turning);
  return state;
}

TEST(SoftHold, IsTheHandsPoseWithoutSoftTissueAndOutsideOfIt) {
  SoftHold hold;
  const ToolPose hand = poseAt({1.0, 2.0, 3.0});
  for (const SoftTissueField* field : {static_cast<const SoftTissueField*>(nullptr), &wall()}) {
    const SoftHold::State state = hold.update(field, roundBur(), hand, {}, false);
    EXPECT_EQ(state.X_PT.translation_mm, hand.translation_mm);
    EXPECT_EQ(state.X_PT.rotation, hand.rotation);
    EXPECT_FALSE(state.touch.touches());
    EXPECT_EQ(state.touch.force_P_N.xyz, glm::dvec3(0.0));
  }
}

TEST(SoftHold, NoBallOfTheInstrumentIsDrawnInsideTheTissue) {
  SoftHold hold;
  const SoftHold::State state = led(hold, wall(), {0.0, 0.0, 0.0}, {6.0, 0.0, 0.0});
  const InstrumentOutline outline = outlineOf(roundBur());
  for (std::size_t n = 0; n < outline.count; ++n) {
    const glm::dvec3 centre =
        state.X_PT.translation_mm + state.X_PT.rotation * glm::dvec3(0.0, 0.0, outline.balls[n].z_mm);
    EXPECT_GT(wall().at(centre).distance_mm, outline.balls[n].radius_mm - 0.05) << n;
  }
  EXPECT_EQ(state.touch.tissue, SoftTissue::lip);
  EXPECT_NEAR(state.touch.place_P.mm.x, 10.0, 0.1);
}

TEST(SoftHold, ForcePushesOutGrowsWithDepthAndStaysBelowItsLimit) {
  SoftHold hold;
  double last_N = 0.0;
  for (const double x_mm : {2.0, 3.0, 4.0, 6.0, 9.0, 15.0}) {
    const SoftHold::State state = led(hold, wall(), {0.0, 0.0, 0.0}, {x_mm, 0.0, 0.0});
    const double force_N = glm::length(state.touch.force_P_N.xyz);
    EXPECT_LT(state.touch.force_P_N.xyz.x, 0.0);
    EXPECT_GE(force_N, last_N);
    EXPECT_LE(force_N, SoftHoldLaw::kMaxForce_N);
    EXPECT_GT(state.touch.depth_mm, 0.0);
    last_N = force_N;
  }
}

TEST(SoftHold, HeadPressedOnAFlatWallFollowsTheLawInClosedForm) {
  // The wall is at z < -10: the bur's tip touches, nothing tilts.
  const SoftTissueField floor = fieldOf([](const glm::dvec3& p) { return p.z + 10.0; }, SoftTissue::tongue);
  SoftHold hold;
  const double depth_mm = 2.0;
  const SoftHold::State state = led(hold, floor, {0.0, 0.0, 0.0}, {0.0, 0.0, -8.5 - depth_mm});
  const double expected_N = SoftHoldLaw::kMaxForce_N *
                            (1.0 - std::exp(-SoftHoldLaw::kStiffness_N_per_mm * depth_mm / SoftHoldLaw::kMaxForce_N));
  EXPECT_NEAR(state.touch.force_P_N.xyz.z, expected_N, 0.01);
  EXPECT_NEAR(state.touch.depth_mm, depth_mm, 0.03);
  EXPECT_EQ(state.touch.tissue, SoftTissue::tongue);
}

TEST(SoftHold, HandpieceDoesNotPassTheLip) {
  SoftHold hold;
  const SoftHold::State state = led(hold, lipRing(), {0.0, 0.0, 0.0}, {40.0, 0.0, 0.0});
  EXPECT_TRUE(assets::contains(state.touch.tissues, SoftTissue::lip));
  // The axis at the lip's height is still within the ring.
  const glm::dvec3 axis_P = state.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const double along = (35.0 - state.X_PT.translation_mm.z) / axis_P.z;
  EXPECT_LT(state.X_PT.translation_mm.x + along * axis_P.x, 13.0);
}

TEST(SoftHold, ATurningBurIsNotHeldAndSaysWhatItCuts) {
  const SoftTissueField floor = fieldOf([](const glm::dvec3& p) { return p.z + 10.0; }, SoftTissue::gingiva);
  SoftHold hold;
  const SoftHold::State state = led(hold, floor, {0.0, 0.0, 0.0}, {0.0, 0.0, -9.3}, true);
  EXPECT_EQ(state.X_PT.translation_mm.z, -9.3);
  EXPECT_EQ(state.touch.bur_cuts, SoftTissue::gingiva);
}

TEST(SoftHold, TissueInWhichItStartsDoesNotPushAndHoldsWhatHasLeftIt) {
  SoftHold hold;
  SoftHold::State state = hold.update(&wall(), roundBur(), poseAt({9.5, 0.0, 0.0}), {}, false);
  EXPECT_EQ(glm::length(state.touch.force_P_N.xyz), 0.0);
  EXPECT_TRUE(state.touch.touches());
  led(hold, wall(), {9.5, 0.0, 0.0}, {0.0, 0.0, 0.0});
  state = led(hold, wall(), {0.0, 0.0, 0.0}, {9.5, 0.0, 0.0});
  EXPECT_LT(state.touch.force_P_N.xyz.x, -0.3);
}

/// A seeded hand that wanders and tilts around the lip at up to 200 mm/s.
template <class Visit>
void wander(std::uint32_t seed, int ticks, Visit&& visit) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  glm::dvec3 p(0.0), v(0.0), turn(0.0), spin(0.0);
  for (int n = 0; n < ticks; ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] += 4.0 * normal(random) - 0.01 * v[axis] - 0.02 * p[axis];
      spin[axis] += 0.02 * normal(random) - 0.01 * spin[axis] - 0.02 * turn[axis];
    }
    if (glm::length(v) > 200.0) v *= 200.0 / glm::length(v);
    p += 1e-3 * v, turn += 1e-3 * spin;
    const double angle = std::max(1e-9, glm::length(turn));
    visit(ToolPose{glm::angleAxis(angle, turn / angle), p}, Vector<Patient>{v});
  }
}

TEST(SoftHold, ForceIsContinuousAndBoundedOnRandomMotions) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    SoftHold hold;
    glm::dvec3 last_N(0.0);
    double steepest_N = 0.0;
    wander(seed, 6000, [&](const ToolPose& hand, const Vector<Patient>& v) {
      const SoftHold::State state = hold.update(&lipRing(), roundBur(), hand, v, false);
      const glm::dvec3 force_N = state.touch.force_P_N.xyz;
      ASSERT_LE(glm::length(force_N), SoftHoldLaw::kMaxForce_N + 1e-12);
      steepest_N = std::max(steepest_N, glm::distance(force_N, last_N));
      last_N = force_N;
    });
    // 0.2 mm a tick at 0.25 N/mm, and sliding around the ring: below the slew limit of 0.3 N a tick.
    EXPECT_LT(steepest_N, 0.3) << seed;
  }
}

TEST(SoftHold, HandGetsNoEnergyFromPressingAlongAnyPathOfAFlatWall) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    SoftHold hold;
    double work_Nmm = 0.0, least_Nmm = 0.0;
    glm::dvec3 last_p(0.0), last_N(0.0), last_M(0.0);
    glm::dquat last_q(1.0, 0.0, 0.0, 0.0);
    wander(seed, 6000, [&](const ToolPose& hand, const Vector<Patient>&) {
      const SoftHold::State state = hold.update(&wall(), roundBur(), hand, {}, false);
      const glm::dquat by = hand.rotation * glm::conjugate(last_q);
      const glm::dvec3 turn = 2.0 * glm::dvec3(by.x, by.y, by.z);
      // Put in by the hand.
      work_Nmm -= glm::dot(0.5 * (state.touch.force_P_N.xyz + last_N), hand.translation_mm - last_p) +
                  glm::dot(0.5 * (state.touch.torque_P_Nmm.xyz + last_M), turn);
      least_Nmm = std::min(least_Nmm, work_Nmm);
      last_p = hand.translation_mm, last_q = hand.rotation;
      last_N = state.touch.force_P_N.xyz, last_M = state.touch.torque_P_Nmm.xyz;
    });
    EXPECT_GT(least_Nmm, -0.1) << seed;
  }
}

/// Closed paths of the hand: a few random poses around the lip, in a loop that is passed some times and left again.
template <class Visit>
void goRound(std::uint32_t seed, double mm_per_tick, Visit&& visit) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> beside(-22.0, 22.0), height(-8.0, 20.0), turn(-0.35, 0.35);
  std::vector<ToolPose> corners{poseAt({0.0, 0.0, 0.0})};
  for (int n = 0; n < 4; ++n)
    corners.push_back({glm::normalize(glm::dquat(1.0, turn(random), turn(random), turn(random))),
                       {beside(random), beside(random), height(random)}});
  const auto go = [&](const ToolPose& from, const ToolPose& to) {
    const int ticks = 1 + static_cast<int>(glm::distance(from.translation_mm, to.translation_mm) / mm_per_tick);
    for (int n = 1; n <= ticks; ++n) {
      const double part = n / double(ticks);
      visit(ToolPose{glm::slerp(from.rotation, to.rotation, part),
                     glm::mix(from.translation_mm, to.translation_mm, part)});
    }
  };
  for (int round = 0; round < 5; ++round) {
    for (std::size_t n = 1; n < corners.size(); ++n) go(corners[n - 1], corners[n]);
    go(corners.back(), round < 4 ? corners[1] : corners[0]);
  }
}

/// What the hand has put in so far, by the midpoint rule.
class HandsWork {
 public:
  void add(const ToolPose& hand, const SoftTouch& felt) {
    const glm::dquat by = hand.rotation * glm::conjugate(last_.rotation);
    const glm::dvec3 turn = 2.0 * glm::dvec3(by.x, by.y, by.z) * (by.w < 0.0 ? -1.0 : 1.0);
    work_Nmm_ -= glm::dot(0.5 * (felt.force_P_N.xyz + last_N_), hand.translation_mm - last_.translation_mm) +
                 glm::dot(0.5 * (felt.torque_P_Nmm.xyz + last_Nmm_), turn);
    least_Nmm_ = std::min(least_Nmm_, work_Nmm_);
    last_ = hand, last_N_ = felt.force_P_N.xyz, last_Nmm_ = felt.torque_P_Nmm.xyz;
  }
  double work_Nmm() const { return work_Nmm_; }
  double least_Nmm() const { return least_Nmm_; }

 private:
  ToolPose last_;
  glm::dvec3 last_N_{0.0}, last_Nmm_{0.0};
  double work_Nmm_ = 0.0, least_Nmm_ = 0.0;
};

/// The end of the instrument slips past the lip and comes back another way: the held pose is not a function of the
/// hand's, and a spring without an account would give back what nobody put in.
TEST(SoftHold, GivesNoMoreThanWasPutInOnAnyClosedPath) {
  double most_put_in_Nmm = 0.0;
  for (const double mm_per_tick : {0.02, 0.1, 0.3})
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
      SoftHold hold;
      HandsWork hands;
      double most_N = 0.0;
      int touches = 0;
      bool touched = false;
      goRound(seed, mm_per_tick, [&](const ToolPose& hand) {
        const SoftHold::State state = hold.update(&lipRing(), roundBur(), hand, {}, false);
        hands.add(hand, state.touch);
        most_N = std::max(most_N, glm::length(state.touch.force_P_N.xyz));
        touches += !touched && state.touch.touches() ? 1 : 0;
        touched = state.touch.touches();
      });
      // Of each touch the tolerance, and one tick of the last force.
      const double most_given_Nmm = touches * (SpringAccount::kTolerance_Nmm + 0.5 * most_N * mm_per_tick);
      EXPECT_GE(hands.least_Nmm(), -most_given_Nmm) << seed << " " << mm_per_tick;
      most_put_in_Nmm = std::max(most_put_in_Nmm, hands.work_Nmm());
    }
  EXPECT_GT(most_put_in_Nmm, 1.0) << "the paths meet the lip";
}

/// Every tick of a servo with soft tissue under a wandering hand.
std::vector<Tick> wandered(const SoftTissueField& field, std::uint32_t seed, bool pedal) {
  Bodies bone = phantom::halfSpace(12.0, 0.5).bodies(1);
  Servo servo(bone, &field);
  Command command;
  command.tool = roundBur();
  std::vector<Tick> ticks;
  wander(seed, 3000, [&](const ToolPose& hand_pose, const Vector<Patient>& v) {
    HandSample hand;
    hand.X_PT = hand_pose;
    hand.velocity_P_mm_per_s = v;
    hand.handle_velocity_P_mm_per_s = v;
    hand.drill_pedal = pedal;
    ticks.push_back(servo.step(hand, command, 1e-3));
  });
  return ticks;
}

TEST(ServoWithSoftTissue, SameInputsGiveTheSameBits) {
  const std::vector<Tick> a = wandered(lipRing(), 3, true), b = wandered(lipRing(), 3, true);
  bool touched = false;
  for (std::size_t n = 0; n < a.size(); ++n) {
    ASSERT_EQ(a[n].commanded_force_P_N.xyz, b[n].commanded_force_P_N.xyz) << n;
    ASSERT_EQ(a[n].soft.force_P_N.xyz, b[n].soft.force_P_N.xyz) << n;
    ASSERT_EQ(a[n].proxy_P.mm, b[n].proxy_P.mm) << n;
    touched = touched || a[n].soft.touches();
  }
  EXPECT_TRUE(touched);
}

TEST(ServoWithSoftTissue, CommandedForceStaysFiniteAndWithinLimitsForAnyField) {
  std::mt19937 random(11);
  for (int n = 0; n < 4; ++n) {
    SoftTissueField wild = lipRing();
    std::uniform_int_distribution<int> any(-32768, 32767), byte(0, 255);
    for (std::int16_t& value : wild.distance) value = static_cast<std::int16_t>(any(random));
    for (std::uint8_t& value : wild.tissue) value = static_cast<std::uint8_t>(byte(random));
    if (n == 1) wild.grid.spacing_mm = std::numeric_limits<double>::quiet_NaN();
    if (n == 2) wild.grid.origin_P_mm.x = std::numeric_limits<double>::infinity();
    if (n == 3) wild.grid.spacing_mm = 1e-300;
    for (const Tick& tick : wandered(wild, 5, n % 2 == 0)) {
      const double force_N = glm::length(tick.commanded_force_P_N.xyz);
      ASSERT_TRUE(std::isfinite(force_N)) << n << " tick " << tick.index;
      ASSERT_LE(force_N, SafetyLimits{}.peak_force_N + 1e-9) << n;
    }
  }
}

TEST(ServoWithSoftTissue, AllocatesNothing) {
  Bodies bone = phantom::halfSpace(12.0, 0.5).bodies(1);
  Servo servo(bone, &lipRing());
  Command command;
  command.tool = roundBur();
  HandSample hand;
  const std::size_t before = allocation_count::onThisThread();
  for (int n = 0; n < 200; ++n) {
    hand.X_PT.translation_mm.x = 0.1 * n;
    (void)servo.step(hand, command, 1e-3);
  }
  EXPECT_EQ(allocation_count::onThisThread(), before);
}

}  // namespace
}  // namespace haptics
