#include "app/session/packing.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "app/session/compressed.h"
#include "app/session/session_error.h"
#include "tests/app/small_session.h"

namespace app {
namespace {

TEST(Packing, BringsEveryFieldOfATickBackBitForBit) {
  haptics::Tick tick = test::imaginedTick(123456789012ULL, 77);
  tick.faults = haptics::Fault::device | haptics::Fault::bad_force;
  tick.state = haptics::SafetyState::armed;
  tick.hand.device_healthy = false;
  tick.rest = haptics::Rest::caught;
  tick.strokes = 31;
  tick.hand.jacobian_P_mm = glm::dmat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
  tick.hand.handle_velocity_P_mm_per_s.xyz = {1.5, -2.5, 3.5};
  tick.hand.motor_heat = 0.7;
  tick.hand.gap_s = 0.021;
  tick.hand.docked = tick.hand.stop_asked = true;
  tick.hand.fresh = tick.hand.held = tick.hand.calibrated = false;
  tick.hand.X_PT.translation_mm = {-0.0, std::numeric_limits<double>::denorm_min(), INFINITY};
  const auto back = unpackTicks(packTicks(std::vector{tick, test::imaginedTick(7)}));
  ASSERT_EQ(back.size(), 2u);
  const haptics::Tick& b = back[0];
  EXPECT_EQ(b.index, tick.index);
  EXPECT_EQ(b.t_s, tick.t_s);
  EXPECT_EQ(b.dt_s, tick.dt_s);
  EXPECT_EQ(b.command_serial, tick.command_serial);
  EXPECT_EQ(b.hand.X_PT.rotation, tick.hand.X_PT.rotation);
  EXPECT_EQ(b.hand.X_PT.translation_mm, tick.hand.X_PT.translation_mm);
  EXPECT_TRUE(std::signbit(b.hand.X_PT.translation_mm.x));
  EXPECT_EQ(b.hand.velocity_P_mm_per_s.xyz, tick.hand.velocity_P_mm_per_s.xyz);
  EXPECT_EQ(b.hand.drill_pedal, tick.hand.drill_pedal);
  EXPECT_EQ(b.hand.device_healthy, tick.hand.device_healthy);
  EXPECT_EQ(b.hand.jacobian_P_mm, tick.hand.jacobian_P_mm);
  EXPECT_EQ(b.hand.handle_velocity_P_mm_per_s.xyz, glm::dvec3(1.5, -2.5, 3.5));
  EXPECT_EQ(b.hand.motor_heat, 0.7);
  EXPECT_EQ(b.hand.gap_s, 0.021);
  EXPECT_TRUE(b.hand.docked && b.hand.stop_asked);
  EXPECT_FALSE(b.hand.fresh || b.hand.held || b.hand.calibrated);
  EXPECT_EQ(b.proxy_P.mm, tick.proxy_P.mm);
  EXPECT_EQ(b.law_force_P_N.xyz, tick.law_force_P_N.xyz);
  EXPECT_EQ(b.served_force_P_N.xyz, tick.served_force_P_N.xyz);
  EXPECT_EQ(b.hand.arm_P_mm.xyz, tick.hand.arm_P_mm.xyz);
  EXPECT_EQ(b.law_torque_P_Nmm.xyz, tick.law_torque_P_Nmm.xyz);
  EXPECT_EQ(b.served_torque_P_Nmm.xyz, tick.served_torque_P_Nmm.xyz);
  EXPECT_EQ(b.energy_Nmm, tick.energy_Nmm);
  EXPECT_EQ(b.spindle_rad_per_s, tick.spindle_rad_per_s);
  EXPECT_EQ(b.overlap_mm3, tick.overlap_mm3);
  EXPECT_EQ(b.depth_mm, tick.depth_mm);
  EXPECT_EQ(b.removed_mm3, tick.removed_mm3);
  EXPECT_EQ(b.bone_digest, tick.bone_digest);
  EXPECT_EQ(b.contact_tissue, tick.contact_tissue);
  EXPECT_EQ(b.drilling, tick.drilling);
  EXPECT_EQ(b.rest, tick.rest);
  EXPECT_EQ(b.strokes, tick.strokes);
  EXPECT_EQ(b.state, haptics::SafetyState::armed);
  EXPECT_EQ(b.faults, tick.faults);
  EXPECT_EQ(b.work_us, tick.work_us);
  EXPECT_EQ(back[1].index, 7u);
}

TEST(Packing, StoresLittleEndianPlanesInTheOrderOfTheStruct) {
  haptics::Tick first, second;
  first.index = 0x0102;
  second.index = 0x0304;
  const auto bytes = packTicks(std::vector{first, second});
  ASSERT_EQ(bytes.size(), 2 * packedTickBytes());
  EXPECT_EQ(bytes[0], 0x02);
  EXPECT_EQ(bytes[1], 0x04);
  EXPECT_EQ(bytes[2], 0x01);
  EXPECT_EQ(bytes[3], 0x03);
}

TEST(Packing, BringsACommandBack) {
  haptics::Command command;
  command.serial = 9;
  command.tool.head.radius_mm = 1.1;
  command.drill_enabled = false;
  command.irrigating = false;
  command.undo_serial = 0x0123456789abcdef;
  command.law.agus.stiffness_N_per_mm = 0.7;
  command.law.damping_Ns_per_mm = 0.002;
  command.erosion.time.removal_rate_per_s = 3.5;
  command.erosion.tissue_factor[4] = 0.123;
  command.safety = {2.9, 250.0, 60.0, 4000.0, 7.0, 0.004, 0.9, {1.0, 2.0, 3.0}, 2000.0, 90.0, true, {}};
  command.safety.thresholds.let_go_s = 0.06;
  command.safety.thresholds.share_of_hottest = 0.2;
  command.rearm = 5;
  EXPECT_EQ(packCommand(unpackCommand(packCommand(command))), packCommand(command));
  const haptics::Command back = unpackCommand(packCommand(command));
  EXPECT_EQ(back.serial, 9u);
  EXPECT_EQ(back.tool.head.radius_mm, 1.1);
  EXPECT_FALSE(back.drill_enabled);
  EXPECT_FALSE(back.irrigating);
  EXPECT_EQ(back.undo_serial, 0x0123456789abcdefu);
  EXPECT_EQ(back.law.damping_Ns_per_mm, 0.002);
  EXPECT_EQ(back.erosion.tissue_factor[4], 0.123);
  EXPECT_EQ(back.safety.slew_N_per_s, 250.0);
  EXPECT_EQ(back.safety.peak_torque_Nmm, 60.0);
  EXPECT_EQ(back.safety.slew_Nmm_per_s, 4000.0);
  EXPECT_EQ(back.safety.most_stiffness_N_per_mm, 7.0);
  EXPECT_EQ(back.safety.continuous_force_N, 0.9);
  EXPECT_EQ(back.safety.peak_joint_torque_Nmm, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_TRUE(back.safety.must_be_armed);
  EXPECT_EQ(back.safety.thresholds.let_go_s, 0.06);
  EXPECT_EQ(back.safety.thresholds.share_of_hottest, 0.2);
  EXPECT_EQ(back.rearm, 5u);
}

TEST(Packing, RefusesBytesOfAnotherLength) {
  std::vector<std::uint8_t> bytes = packTicks(test::imaginedTicks(0, 3));
  bytes.pop_back();
  EXPECT_THROW(unpackTicks(bytes), SessionError);
  EXPECT_THROW(unpackCommand(bytes), SessionError);
}

TEST(Compressed, RefusesAnythingButTheExpectedBytes) {
  const std::vector<std::uint8_t> bytes(1000, 42);
  std::vector<std::uint8_t> packed = compress(bytes);
  EXPECT_EQ(decompress(packed, 1000), bytes);
  EXPECT_THROW(decompress(packed, 999), SessionError);
  packed.resize(packed.size() / 2);
  EXPECT_THROW(decompress(packed, 1000), SessionError);
  EXPECT_THROW(decompress({}, 1000), SessionError);
}

}  // namespace
}  // namespace app
