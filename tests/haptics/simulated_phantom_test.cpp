#include "haptics/device/simulated/simulated_phantom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "calibration/geometry/units.h"
#include "haptics/device/simulated/work_cycle.h"
#include "tests/haptics/allocation_count.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::PhantomJoints;
using calibration::Vector;

const PhantomMechanics& phantom(std::string_view key) { return *findSimulatedPhantom(key); }

constexpr Grip kSteady = {0.055, 0.3, 0.003, 0.0};
constexpr glm::dvec3 kMiddle_mm(3.0, -2.0, 5.0);

HandScript holdingAt(const glm::dvec3& position_mm) {
  return [position_mm](double) {
    HandTarget target;
    target.position_mm = position_mm;
    return target;
  };
}

Wrench<Device> push(const glm::dvec3& force_N) { return {{force_N}, {}}; }

/// In its rest, taken at 0.1 s, up by 20 mm at 0.4 s, back at 0.7 s and let go of at 0.8 s.
HandScript takingFrom(const glm::dvec3& rest_mm) {
  return [rest_mm](double t_s) {
    HandTarget target;
    const double up = t_s < 0.4 ? (t_s - 0.1) / 0.3 : (0.7 - t_s) / 0.3;
    target.position_mm = rest_mm + glm::dvec3(0.0, 20.0 * std::clamp(up, 0.0, 1.0), 0.0);
    target.grips = t_s >= 0.1 && t_s < 0.8;
    target.buttons = t_s > 0.3 && t_s < 0.5 ? 2u : 0u;
    return target;
  };
}

HandleState stepped(SimulatedPhantom& device, const glm::dvec3& force_N, int ticks) {
  HandleState state;
  for (int tick = 0; tick < ticks; ++tick) state = device.exchange(push(force_N), 1e-3);
  return state;
}

TroughPath trough() {
  assets::StraightCut cut;
  cut.outward_P = {0.0, 0.4, 0.9};
  cut.lateral_P = {1.0, 0.0, 0.0};
  cut.depth_mm = 3.75;  // an odd number of passes: it ends where it did not begin
  return TroughPath(assets::plannedAlong(cut));
}

TEST(SimulatedPhantom, HasTheParametersOfItsModel) {
  const auto capabilities = [](std::string_view key) {
    return SimulatedPhantom(phantom(key), holdingAt(kMiddle_mm)).capabilities();
  };
  const DeviceCapabilities omni = capabilities("omni"), desktop = capabilities("desktop"),
                           premium = capabilities("premium");
  EXPECT_EQ(omni.model, "simulated Phantom Omni");
  for (const DeviceCapabilities* can : {&omni, &desktop, &premium}) {
    EXPECT_TRUE(can->has_motors);
    EXPECT_EQ(can->provenance, Provenance::simulated);
    EXPECT_EQ(can->peak_torque_Nmm, 0.0);
  }
  EXPECT_EQ(omni.peak_force_N, 3.3);
  EXPECT_EQ(desktop.peak_force_N, 7.9);
  EXPECT_EQ(premium.peak_force_N, 8.5);
  EXPECT_EQ(omni.continuous_force_N, 0.88);
  EXPECT_EQ(omni.peak_joint_torque_Nmm, glm::dvec3(350.0));
  EXPECT_TRUE(omni.has_inkwell && !omni.has_deadman && desktop.has_deadman && !desktop.has_inkwell);
  EXPECT_EQ(findSimulatedPhantom("falcon"), nullptr);
}

TEST(SimulatedPhantom, LeavesItsInkwellInTheHandAndComesBack) {
  SimulatedPhantom device(phantom("omni"), takingFrom(phantom("omni").rest_D.mm), kSteady);
  HandleState state = stepped(device, {}, 50);
  EXPECT_TRUE(state.docked && state.calibrated);
  EXPECT_LT(glm::distance(state.X_DH.translation_mm, phantom("omni").rest_D.mm), 0.06);
  // What is left in the inkwell stays, whatever the motors do.
  state = stepped(device, {0.0, 3.0, 0.0}, 40);
  EXPECT_TRUE(state.docked);
  state = stepped(device, {}, 310);
  EXPECT_FALSE(state.docked);
  EXPECT_GT(state.X_DH.translation_mm.y, phantom("omni").rest_D.mm.y + 15.0);
  EXPECT_EQ(state.buttons, 2u);
  state = stepped(device, {}, 500);
  EXPECT_TRUE(state.docked && state.calibrated);
  EXPECT_LT(glm::distance(state.X_DH.translation_mm, phantom("omni").rest_D.mm), 0.06);
}

TEST(SimulatedPhantom, IsCalibratedOnlyFromTheInkwell) {
  SimulatedPhantom omni(phantom("omni"), holdingAt(kMiddle_mm)), premium(phantom("premium"), holdingAt(kMiddle_mm));
  EXPECT_FALSE(stepped(omni, {}, 10).calibrated);
  EXPECT_TRUE(stepped(premium, {}, 10).calibrated);
}

TEST(SimulatedPhantom, SensesTheHandIfItHasADeadman) {
  for (const char* key : {"omni", "desktop"}) {
    SimulatedPhantom device(phantom(key), takingFrom(phantom(key).rest_D.mm), kSteady);
    EXPECT_EQ(stepped(device, {}, 50).held, std::string_view(key) == "omni");
    EXPECT_TRUE(stepped(device, {}, 200).held);
  }
}

TEST(SimulatedPhantom, PushesTheHandAsFarAsItsGripYields) {
  for (const PhantomMechanics& mechanics : simulatedPhantoms()) {
    SimulatedPhantom device(mechanics, holdingAt(kMiddle_mm), kSteady);
    const HandleState state = stepped(device, {0.0, 0.8, 0.0}, 2000);
    const double moved_mm = state.X_DH.translation_mm.y - kMiddle_mm.y;
    EXPECT_GT(moved_mm, (0.8 - mechanics.dry_N) / 0.3 - 0.06) << mechanics.key;
    EXPECT_LT(moved_mm, 0.8 / 0.3 + 0.06) << mechanics.key;
  }
}

TEST(SimulatedPhantom, DoesNotMoveBelowItsFriction) {
  SimulatedPhantom device(phantom("omni"), holdingAt(kMiddle_mm), kSteady);
  const PhantomJoints before = device.joints();
  stepped(device, {0.15, -0.15, 0.1}, 3000);
  EXPECT_EQ(device.joints().arm_rad, before.arm_rad);
}

TEST(SimulatedPhantom, GivesNoMoreThanMotorsAndJointsCan) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const PhantomMechanics& mechanics : simulatedPhantoms()) {
    SimulatedPhantom device(mechanics, holdingAt(kMiddle_mm), kSteady);
    double strongest_N = 0.0, hardest_Nmm = 0.0;
    for (int tick = 0; tick < 2000; ++tick) {
      const glm::dvec3 asked_N = 20.0 * glm::dvec3(normal(random), normal(random), normal(random));
      const glm::dvec3 before_rad = device.joints().arm_rad;
      device.exchange(push(asked_N), 1e-3);
      strongest_N = std::max(strongest_N, glm::length(device.pushed_D_N().xyz));
      const glm::dvec3 torque = glm::abs(armTorque_Nmm(mechanics.geometry, before_rad, device.pushed_D_N()));
      hardest_Nmm = std::max({hardest_Nmm, torque.x, torque.y, torque.z});
    }
    EXPECT_LE(strongest_N, mechanics.peak_force_N * (1.0 + 1e-12)) << mechanics.key;
    EXPECT_LE(hardest_Nmm, mechanics.peak_joint_Nmm * (1.0 + 1e-12)) << mechanics.key;
    EXPECT_GT(std::max(strongest_N / mechanics.peak_force_N, hardest_Nmm / mechanics.peak_joint_Nmm), 0.999);
  }
  // Straight up where the inkwell is, the Omni's thigh gives out first: 3.3 N would take 424 N mm of its 350.
  const PhantomMechanics& omni = phantom("omni");
  SimulatedPhantom device(omni, takingFrom(omni.rest_D.mm), kSteady);
  stepped(device, {0.0, 3.3, 0.0}, 3);
  EXPECT_NEAR(device.pushed_D_N().xyz.y, 3.3 * 350.0 / 424.0, 0.01);
}

TEST(SimulatedPhantom, DelaysTheForceByItsLatency) {
  for (int latency : {0, 1, 2, SimulatedPhantom::kMaxLatency_ticks}) {
    PhantomMechanics mechanics = phantom("desktop");
    mechanics.latency_ticks = latency;
    SimulatedPhantom device(mechanics, holdingAt(kMiddle_mm), kSteady);
    for (int tick = 0; tick < 40; ++tick) {
      device.exchange(push({tick == 10 ? 0.5 : 0.0, 0.0, 0.0}), 1e-3);
      EXPECT_EQ(device.pushed_D_N().xyz.x, tick == 10 + latency ? 0.5 : 0.0) << latency << " " << tick;
    }
  }
}

TEST(SimulatedPhantom, WarmsUpAndThenGivesOnlyItsContinuousForce) {
  const PhantomMechanics& omni = phantom("omni");
  SimulatedPhantom device(omni, holdingAt(kMiddle_mm), {0.055, 3.0, 0.02, 0.0});
  const glm::dvec3 hard_N(0.0, 2.5, 0.0);
  double most_heat = 0.0;
  for (int tick = 0; tick < 20'000; ++tick)
    most_heat = std::max(most_heat, device.exchange(push(hard_N), 1e-3).motor_heat);
  EXPECT_GE(most_heat, 1.0);
  EXPECT_LT(most_heat, 1.01);
  EXPECT_LE(glm::length(device.pushed_D_N().xyz), 2.5 + 1e-9);
  double mean_N = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    device.exchange(push(hard_N), 1e-3);
    mean_N += device.pushed_D_N().xyz.y / 1000.0;
  }
  EXPECT_LT(mean_N, 1.3 * omni.continuous_force_N);
  const double warm = stepped(device, {}, 1).motor_heat;
  EXPECT_NEAR(stepped(device, {}, 3000).motor_heat, warm * std::exp(-3.0 / omni.heat_time_s), 1e-6);
}

TEST(SimulatedPhantom, StaysWithinItsStops) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(-400.0, 400.0);
  for (const PhantomMechanics& mechanics : simulatedPhantoms()) {
    std::array<glm::dvec3, 8> wishes;
    for (glm::dvec3& wish : wishes) wish = {any(random), any(random), any(random)};
    wishes[0] = kMiddle_mm;
    SimulatedPhantom device(mechanics, [&](double t_s) {
      HandTarget target;
      const double u = 4.0 * t_s;
      const auto n = static_cast<std::size_t>(u) % wishes.size();
      target.position_mm = glm::mix(wishes[n], wishes[(n + 1) % wishes.size()], u - std::floor(u));
      target.rotation = glm::angleAxis(5.0 * t_s, glm::normalize(glm::dvec3(1.0, 0.4, -0.3)));
      return target;
    });
    glm::dvec3 last_mm = kMiddle_mm;
    for (int tick = 0; tick < 4000; ++tick) {
      const HandleState state = device.exchange({}, 1e-3);
      ASSERT_LT(glm::distance(state.X_DH.translation_mm, last_mm), 12.0) << mechanics.key << " leaps at " << tick;
      last_mm = state.X_DH.translation_mm;
      ASSERT_TRUE(withinLimits(mechanics.geometry, device.joints().arm_rad)) << mechanics.key << " " << tick;
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(mechanics.geometry.wrist[axis].contains(device.joints().wrist_rad[static_cast<int>(axis)]));
      ASSERT_TRUE(std::isfinite(glm::length(state.X_DH.translation_mm)));
      ASSERT_NEAR(glm::length(state.X_DH.rotation), 1.0, 1e-9);
    }
  }
}

TEST(SimulatedPhantom, IgnoresAnInvalidForce) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  SimulatedPhantom device(phantom("omni"), holdingAt(kMiddle_mm));
  for (const glm::dvec3& bad :
       {glm::dvec3(nan, 0, 0), glm::dvec3(inf, 0, 0), glm::dvec3(0, -inf, nan), glm::dvec3(1e300, 1e300, 1e300)})
    for (double dt_s : {1e-3, 0.0}) {
      const HandleState state = device.exchange(push(bad), dt_s);
      EXPECT_TRUE(std::isfinite(glm::length(state.X_DH.translation_mm)));
      EXPECT_TRUE(std::isfinite(glm::length(state.velocity_D_mm_per_s.xyz)));
      EXPECT_TRUE(std::isfinite(state.motor_heat));
    }
  EXPECT_LT(glm::distance(stepped(device, {}, 1000).X_DH.translation_mm, kMiddle_mm), 1.5);
}

TEST(SimulatedPhantom, AllocatesNothingWhileItTicks) {
  const PhantomMechanics& omni = phantom("omni");
  const HandTarget rest{omni.rest_D.mm, {1.0, 0.0, 0.0, 0.0}, false, 0, true};
  const WorkCycle round(trough(), rest, {{0.0, -60.0, 40.0}});
  SimulatedPhantom device(omni, [round](double t_s) { return round.at(t_s); });
  const std::size_t before = allocation_count::now();
  for (int tick = 0; tick < 5000; ++tick) device.exchange(push({0.0, 0.0, 0.5}), 1e-3);
  EXPECT_EQ(allocation_count::now(), before);
}

TEST(SimulatedPhantom, IsDeterministic) {
  const auto course = [](std::uint32_t seed) {
    SimulatedPhantom device(phantom("omni"), holdingAt(kMiddle_mm), {}, seed);
    std::vector<glm::dvec3> places;
    for (int tick = 0; tick < 500; ++tick) {
      const HandleState state = device.exchange(push({0.1, 0.0, 0.5}), 1e-3);
      places.push_back(state.X_DH.translation_mm + state.X_DH.rotation * glm::dvec3(0.0, 0.0, -40.0));
    }
    return places;
  };
  EXPECT_EQ(course(4), course(4));
  EXPECT_NE(course(4), course(5));
  // The gimbal's noise is of the seed too.
  SimulatedPhantom one(phantom("omni"), holdingAt(kMiddle_mm), kSteady, 4),
      other(phantom("omni"), holdingAt(kMiddle_mm), kSteady, 5);
  bool differs = false;
  for (int tick = 0; tick < 50; ++tick)
    differs = differs || one.exchange({}, 1e-3).X_DH.rotation != other.exchange({}, 1e-3).X_DH.rotation;
  EXPECT_TRUE(differs);
}

TEST(SimulatedPhantom, MovesTheSameAtEveryRate) {
  const auto where = [](double rate_Hz) {
    PhantomMechanics mechanics = phantom("desktop");
    mechanics.sensing = {};
    mechanics.latency_ticks = 0;
    SimulatedPhantom device(mechanics, holdingAt(kMiddle_mm));
    HandleState state;
    for (int tick = 0; tick < static_cast<int>(rate_Hz); ++tick)
      state = device.exchange(push({0.3, 0.5, -0.4}), 1.0 / rate_Hz);
    return state.X_DH.translation_mm;
  };
  EXPECT_LT(glm::distance(where(1000.0), where(10'000.0)), 0.01);
  EXPECT_LT(glm::distance(where(500.0), where(10'000.0)), 0.02);
}

TEST(SimulatedPhantom, RefusesImpossibleParameters) {
  const auto refused = [](auto change) {
    PhantomMechanics mechanics = phantom("omni");
    Grip grip;
    HandScript script = holdingAt(kMiddle_mm);
    change(mechanics, grip, script);
    EXPECT_THROW(SimulatedPhantom(mechanics, script, grip), DeviceError);
  };
  refused([](auto& mechanics, auto&, auto&) { mechanics.mass_kg = 0.0; });
  refused([](auto& mechanics, auto&, auto&) { mechanics.dry_N = std::nan(""); });
  refused([](auto& mechanics, auto&, auto&) { mechanics.latency_ticks = 16; });
  refused([](auto& mechanics, auto&, auto&) { mechanics.latency_ticks = -1; });
  refused([](auto& mechanics, auto&, auto&) { mechanics.geometry.shin_mm = 0.0; });
  refused([](auto&, auto& grip, auto&) { grip.stiffness_N_per_mm = -1.0; });
  refused([](auto&, auto&, auto& script) { script = holdingAt({0.0, 0.0, 500.0}); });
}

TEST(WorkCycle, TakesTheHandleWorksAndPutsItBack) {
  const PhantomMechanics& omni = phantom("omni");
  const HandTarget rest{omni.rest_D.mm, {1.0, 0.0, 0.0, 0.0}, false, 0, true};
  const WorkCycle round(trough(), rest, {{0.0, -60.0, 40.0}, {0.0, 20.0, 50.0}});
  double stood_s = 0.0, longest_s = 0.0, worked_s = 0.0;
  HandTarget last = round.at(0.0);
  EXPECT_FALSE(last.grips);
  EXPECT_EQ(last.position_mm, rest.position_mm);
  for (int tick = 1; tick * 1e-3 < round.duration_s() + 1.0; ++tick) {
    const HandTarget now = round.at(tick * 1e-3);
    const double moved_mm = glm::distance(now.position_mm, last.position_mm);
    ASSERT_LT(moved_mm, 0.2) << tick;
    ASSERT_GT(std::abs(glm::dot(now.rotation, last.rotation)), 0.9999) << tick;
    ASSERT_TRUE(now.grips || now.position_mm == rest.position_mm) << tick;
    ASSERT_TRUE(now.grips || !now.pedal);
    // Before the first stroke it stands where it can be armed.
    const bool away = glm::distance(now.position_mm, rest.position_mm) > 10.0;
    if (worked_s == 0.0) stood_s = away && moved_mm < 0.01 ? stood_s + 1e-3 : 0.0;
    longest_s = std::max(longest_s, stood_s);
    worked_s += now.pedal ? 1e-3 : 0.0;
    last = now;
  }
  EXPECT_GT(longest_s, 0.9);
  EXPECT_GT(worked_s, 10.0);
  EXPECT_FALSE(last.grips);
  EXPECT_EQ(last.position_mm, rest.position_mm);
}

}  // namespace
}  // namespace haptics
