#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "haptics/device/simulated/mouse_device.h"
#include "haptics/device/simulated/scripted_device.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::Vector;

assets::StraightCut slot() {
  assets::StraightCut cut;
  cut.middle_P_mm = {10.0, -5.0, 3.0};
  cut.outward_P = {0.0, 0.0, 1.0};
  cut.lateral_P = {1.0, 0.0, 0.2};
  return cut;
}

TEST(VirtualHand, RestsWhereSpringAndForceBalance) {
  VirtualHand hand;
  for (int i = 0; i < 2000; ++i) hand.advance({1.0, 2.0, 3.0}, glm::dvec3(0.0), {0.5, 0.0, -1.0}, 1e-3);
  EXPECT_NEAR(hand.position_mm.x, 2.0, 1e-9);
  EXPECT_NEAR(hand.position_mm.z, 1.0, 1e-9);
  EXPECT_NEAR(glm::length(hand.velocity_mm_per_s), 0.0, 1e-9);
}

TEST(VirtualHand, MovesTheSameAtEveryRate) {
  VirtualHand fine, coarse;
  for (int i = 0; i < 400; ++i) fine.advance({5.0, 0.0, 0.0}, glm::dvec3(0.0), {0.0, 0.1, 0.0}, 0.25e-3);
  for (int i = 0; i < 5; ++i) coarse.advance({5.0, 0.0, 0.0}, glm::dvec3(0.0), {0.0, 0.1, 0.0}, 20e-3);
  EXPECT_NEAR(glm::length(fine.position_mm - coarse.position_mm), 0.0, 1e-9);
  EXPECT_NEAR(glm::length(fine.velocity_mm_per_s - coarse.velocity_mm_per_s), 0.0, 1e-7);
}

TEST(MouseDevice, MovesSmoothlyToItsTargetAndYieldsToForce) {
  MouseDevice device;
  MouseTarget target;
  target.X_DH.translation_mm = {10.0, 0.0, 0.0};
  target.pedal = true;
  device.setTarget(target);
  double last = 0.0, fastest = 0.0;
  HandleState state;
  for (int i = 0; i < 500; ++i) {
    state = device.exchange({{{0.0, 0.0, 1.0}}, {}}, 1e-3);
    EXPECT_GE(state.X_DH.translation_mm.x, last);
    fastest = std::max(fastest, state.X_DH.translation_mm.x - last);
    last = state.X_DH.translation_mm.x;
  }
  EXPECT_NEAR(last, 10.0, 1e-6);
  EXPECT_LT(fastest, 0.5);
  EXPECT_NEAR(state.X_DH.translation_mm.z, 2.0, 1e-6);
  EXPECT_TRUE(state.pedal);
}

TEST(MouseDevice, BeginsWhereItIsPlaced) {
  MouseDevice device({{glm::dquat(1.0, 0.0, 0.0, 0.0), {-20.0, 0.0, 0.0}}, false});
  MouseTarget place;
  place.X_DH = {glm::normalize(glm::dquat(1.0, 0.0, 1.0, 0.0)), {3.0, 4.0, 5.0}};
  device.placeAt(place);
  for (int n = 0; n < 3; ++n) {
    const HandleState state = device.exchange({}, 1e-3);
    EXPECT_EQ(state.X_DH.translation_mm, place.X_DH.translation_mm);
    EXPECT_NEAR(std::abs(glm::dot(state.X_DH.rotation, place.X_DH.rotation)), 1.0, 1e-12);
  }
}

TEST(MouseDevice, IgnoresAnInvalidTarget) {
  MouseDevice device;
  MouseTarget target;
  target.X_DH.translation_mm.x = std::numeric_limits<double>::quiet_NaN();
  device.setTarget(target);
  target.X_DH = {glm::dquat(0.0, 0.0, 0.0, 0.0), {}};
  device.setTarget(target);
  EXPECT_EQ(device.exchange({}, 1e-3).X_DH.translation_mm, glm::dvec3(0.0));
}

TEST(ScriptedDevice, SweepsTheTroughAndWithdraws) {
  ScriptedDevice hand(assets::plannedAlong(slot()));
  const double R = slot().bur_radius_mm;
  double lowest = 1e9, least_along = 1e9, most_along = -1e9;
  bool drilled = false;
  HandleState state;
  const int ticks = static_cast<int>(hand.duration_s() * 1000.0) + 500;
  glm::dvec3 last = hand.exchange({}, 1e-3).X_DH.translation_mm;
  for (int i = 0; i < ticks; ++i) {
    state = hand.exchange({}, 1e-3);
    const glm::dvec3 place = state.X_DH.translation_mm;
    EXPECT_LT(glm::length(place - last), 0.1);
    last = place;
    lowest = std::min(lowest, place.z - R - slot().middle_P_mm.z);
    if (!state.pedal) continue;
    drilled = true;
    least_along = std::min(least_along, place.y - slot().middle_P_mm.y);
    most_along = std::max(most_along, place.y - slot().middle_P_mm.y);
    EXPECT_NEAR(place.x, slot().middle_P_mm.x, 1e-9);
  }
  EXPECT_TRUE(drilled);
  EXPECT_NEAR(lowest, -slot().depth_mm, 0.05);
  EXPECT_NEAR(most_along, 4.0, 0.2);
  EXPECT_NEAR(least_along, -4.0, 0.2);
  EXPECT_FALSE(state.pedal);
  EXPECT_NEAR(last.z - slot().middle_P_mm.z - R, CuttingMotion{}.clearance_mm, 0.01);
}

TEST(ScriptedDevice, HoldsTheShaftOutOfTheMouth) {
  ScriptedDevice hand(assets::plannedAlong(slot()));
  const glm::dvec3 shaft = hand.exchange({}, 1e-3).X_DH.rotation * glm::dvec3(0.0, 0.0, 1.0);
  EXPECT_GT(shaft.z, 0.8);
  EXPECT_GT(shaft.x, 0.1);
}

TEST(ScriptedDevice, YieldsToForce) {
  ScriptedDevice pushed(assets::plannedAlong(slot())), free(assets::plannedAlong(slot()));
  HandleState a, b;
  for (int i = 0; i < 1500; ++i) {
    a = pushed.exchange({{{0.0, 0.0, 0.5}}, {}}, 1e-3);
    b = free.exchange({}, 1e-3);
  }
  EXPECT_NEAR(a.X_DH.translation_mm.z - b.X_DH.translation_mm.z, 1.0, 0.01);
}

TEST(ScriptedDevice, RefusesAPlanWithoutDirection) {
  assets::StraightCut bad = slot();
  bad.lateral_P = bad.outward_P;
  EXPECT_THROW(ScriptedDevice{assets::plannedAlong(bad)}, DeviceError);
  bad = slot();
  bad.depth_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ScriptedDevice{assets::plannedAlong(bad)}, DeviceError);
}

TEST(TroughPath, TakesThePlanOfThePatientIntoTheFrameOfTheDevice) {
  const calibration::Pose<Device, calibration::Patient> X_DP{
      glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, -2.0, 0.5))), {5.0, 6.0, -7.0}};
  const TroughPath in_P(assets::plannedAlong(slot())), in_D(assets::plannedAlong(slot()), {}, X_DP);
  for (double t_s = 0.0; t_s < in_P.duration_s(); t_s += 0.1) {
    const HandTarget a = in_P.at(t_s), b = in_D.at(t_s);
    EXPECT_LT(glm::distance((X_DP * calibration::Point<calibration::Patient>{a.position_mm}).mm, b.position_mm), 1e-9);
    EXPECT_EQ(a.pedal, b.pedal);
  }
}

TEST(VirtualHand, MovesExactlyWhateverTheStep) {
  // Against a thousand small steps of the explicit rule, for every kind of damping and for none.
  for (double damping : {0.0, 0.001, 2.0 * std::sqrt(0.3 * 1e-4), 0.05})
    for (double stiffness : {0.0, 0.3}) {
      VirtualHand hand;
      hand.stiffness_N_per_mm = stiffness;
      hand.damping_Ns_per_mm = damping;
      hand.friction_Ns_per_mm = 0.002;
      hand.velocity_mm_per_s = {30.0, -10.0, 0.0};
      VirtualHand slow = hand;
      const glm::dvec3 target(1.0, 0.0, 2.0), drift(5.0, 5.0, -5.0), push(0.3, -0.4, 0.5);
      hand.advance(target, drift, push, 0.01);
      constexpr int kSteps = 100'000;
      for (int i = 0; i < kSteps; ++i) {
        const double dt = 0.01 / kSteps;
        const glm::dvec3 pull = stiffness * (target + drift * (dt * i) - slow.position_mm) +
                                damping * (drift - slow.velocity_mm_per_s) - 0.002 * slow.velocity_mm_per_s;
        slow.velocity_mm_per_s += dt * 1e4 * (pull + push);
        slow.position_mm += dt * slow.velocity_mm_per_s;
      }
      EXPECT_LT(glm::length(hand.position_mm - slow.position_mm), 2e-4) << damping << " " << stiffness;
      EXPECT_LT(glm::length(hand.velocity_mm_per_s - slow.velocity_mm_per_s), 0.03) << damping << " " << stiffness;
    }
}

}  // namespace
}  // namespace haptics
