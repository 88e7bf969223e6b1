#include "app/session/tick_columns.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "app/session/session_error.h"
#include "tests/app/session/small_session.h"
#include "tests/refusal.h"

namespace app {
namespace {

TEST(TickColumns, BringsEveryFieldOfATickBackBitForBit) {
  haptics::Tick tick = test::imaginedTick(123456789012ULL, 77);
  tick.faults = haptics::Fault::device | haptics::Fault::bad_force;
  tick.state = haptics::SafetyState::armed;
  tick.hand.device_healthy = false;
  tick.drill_inhibit = haptics::DrillInhibit::tool_embedded;
  tick.strokes = 31;
  tick.hand.jacobian_P_mm = glm::dmat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
  tick.hand.handle_velocity_P_mm_per_s.xyz = {1.5, -2.5, 3.5};
  tick.hand.motor_heat = 0.7;
  tick.hand.gap_s = 0.021;
  tick.hand.docked = tick.hand.stop_requested = true;
  tick.hand.fresh = tick.hand.held = tick.hand.calibrated = false;
  tick.hand.X_PT.translation_mm = {-0.0, std::numeric_limits<double>::denorm_min(), INFINITY};
  const auto back = TickUnpacker(tickColumns()).unpack(packTicks(std::vector{tick, test::imaginedTick(7)}));
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
  EXPECT_TRUE(b.hand.docked && b.hand.stop_requested);
  EXPECT_FALSE(b.hand.fresh || b.hand.held || b.hand.calibrated);
  EXPECT_EQ(b.proxy_P.mm, tick.proxy_P.mm);
  EXPECT_EQ(b.law_force_P_N.xyz, tick.law_force_P_N.xyz);
  EXPECT_EQ(b.commanded_force_P_N.xyz, tick.commanded_force_P_N.xyz);
  EXPECT_EQ(b.hand.arm_P_mm.xyz, tick.hand.arm_P_mm.xyz);
  EXPECT_EQ(b.law_torque_P_Nmm.xyz, tick.law_torque_P_Nmm.xyz);
  EXPECT_EQ(b.commanded_torque_P_Nmm.xyz, tick.commanded_torque_P_Nmm.xyz);
  EXPECT_EQ(b.energy_Nmm, tick.energy_Nmm);
  EXPECT_EQ(b.spindle_rad_per_s, tick.spindle_rad_per_s);
  EXPECT_EQ(b.overlap_mm3, tick.overlap_mm3);
  EXPECT_EQ(b.depth_mm, tick.depth_mm);
  EXPECT_EQ(b.removed_mm3, tick.removed_mm3);
  EXPECT_EQ(b.bone_digest, tick.bone_digest);
  EXPECT_EQ(b.contact_tissue, tick.contact_tissue);
  EXPECT_EQ(b.drilling, tick.drilling);
  EXPECT_EQ(b.drill_inhibit, tick.drill_inhibit);
  EXPECT_EQ(b.strokes, tick.strokes);
  EXPECT_EQ(b.state, haptics::SafetyState::armed);
  EXPECT_EQ(b.faults, tick.faults);
  EXPECT_EQ(b.work_us, tick.work_us);
  EXPECT_EQ(back[1].index, 7u);
}

TEST(TickColumns, StoresLittleEndianPlanesInTheOrderOfTheTable) {
  haptics::Tick first, second;
  first.index = 0x0102;
  second.index = 0x0304;
  const auto bytes = packTicks(std::vector{first, second});
  ASSERT_EQ(bytes.size(), 2 * TickUnpacker(tickColumns()).bytesPerTick());
  EXPECT_EQ(bytes[0], 0x02);
  EXPECT_EQ(bytes[1], 0x04);
  EXPECT_EQ(bytes[2], 0x01);
  EXPECT_EQ(bytes[3], 0x03);
}

TEST(TickColumns, SayWhatTheyAreCalledAndMeasuredIn) {
  const auto column = [](const std::string& name) {
    const auto found = std::ranges::find(tickColumns(), name, &TickColumn::name);
    return found == tickColumns().end() ? TickColumn{} : *found;
  };
  EXPECT_EQ(column("t_s"), (TickColumn{"t_s", "f64", "s", "", ""}));
  EXPECT_EQ(column("proxy_P_mm.y"), (TickColumn{"proxy_P_mm.y", "f64", "mm", "P", ""}));
  EXPECT_EQ(column("hand.docked").type, "u8");
  EXPECT_EQ(column("faults").type, "u32");
  EXPECT_EQ(column("work_us").type, "f32");
  EXPECT_NE(column("state").meaning.find("active 4"), std::string::npos);
  std::set<std::string> names;
  for (const TickColumn& one : tickColumns()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

/// A block with these columns of one tick, in this order.
std::vector<std::uint8_t> bytesOf(std::initializer_list<std::pair<std::uint64_t, std::size_t>> values) {
  std::vector<std::uint8_t> bytes;
  for (const auto& [bits, size] : values)
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  return bytes;
}

TEST(TickColumns, OfAnotherProgramAreReadByNamePassedByOrDefaulted) {
  // Another order, a column this program lacks, others of another width, and most of a tick not there.
  const std::vector<TickColumn> stored = {{"depth_mm", "f32", "", "", ""},
                                          {"pressure_kPa", "f64", "kPa", "", ""},
                                          {"index", "u16", "", "", ""},
                                          {"strokes", "i32", "", "", ""},
                                          {"served_force_P_N.z", "f64", "N", "P", ""}};
  const auto bytes = bytesOf({{std::bit_cast<std::uint32_t>(0.25f), 4},
                              {0x123456789abcdef0, 8},
                              {513, 2},
                              {7, 4},
                              {std::bit_cast<std::uint64_t>(-1.5), 8}});
  const TickUnpacker unpacker(stored);
  EXPECT_EQ(unpacker.bytesPerTick(), 26u);
  const auto ticks = unpacker.unpack(bytes);
  ASSERT_EQ(ticks.size(), 1u);
  EXPECT_EQ(ticks[0].depth_mm, 0.25);
  EXPECT_EQ(ticks[0].index, 513u);
  EXPECT_EQ(ticks[0].strokes, 7);
  EXPECT_EQ(ticks[0].commanded_force_P_N.xyz.z, -1.5);
  EXPECT_TRUE(ticks[0].hand.fresh) << "a column that is not there has the default of its member";
  EXPECT_EQ(ticks[0].state, haptics::SafetyState::off);
}

TEST(TickColumns, RefuseBytesOfAnotherLengthAndTypesThatAreNone) {
  std::vector<std::uint8_t> bytes = packTicks(test::imaginedTicks(0, 3));
  bytes.pop_back();
  EXPECT_THROW(TickUnpacker(tickColumns()).unpack(bytes), SessionError);
  for (const char* type : {"", "f8", "u128", "text", "f64 "})
    EXPECT_THROW(TickUnpacker(std::vector<TickColumn>{{"index", type, "", "", ""}}), SessionError) << type;
  EXPECT_THROW(TickUnpacker(std::vector<TickColumn>{}), SessionError);
  EXPECT_EQ(tests::refusalOf<SessionError>([] {
              TickUnpacker(std::vector<TickColumn>{{"index", "f\n\x1b", "", "", ""}});
            }),
            "a column of its ticks is of type 'f?"
            "?', which is unknown: the session is damaged");
}

}  // namespace
}  // namespace app
