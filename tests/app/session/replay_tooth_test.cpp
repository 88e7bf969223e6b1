// Replays of a tooth that is a body of its own, falls apart, and is gripped.

#include <gtest/gtest.h>

#include "app/session/metrics.h"
#include "app/session/replay.h"
#include "app/session/session_writer.h"
#include "haptics/body/bridge_break.h"
#include "haptics/body/piece_split.h"
#include "haptics/ligament/piece_site.h"
#include "haptics/servo/servo.h"
#include "tests/app/session/real_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr std::size_t kRehearsed = 900;

haptics::Bodies bodiesAt(const std::string& path, double t_s) {
  SessionReader session(path);
  return std::move(replayTo(session, t_s).bodies);
}

TEST(ReplayOfATooth, RebuildsItAsABodyOfItsOwn) {
  const test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.solid.size());
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) { is_tooth[v] = ijk.x > 15 && ijk.x < 26 ? 1 : 0; });
  haptics::Bodies bodies(block.grid, block.solid, block.label, is_tooth);
  ASSERT_EQ(bodies.pieces(), 1u);
  SessionStart start = block.start();
  start.is_tooth = is_tooth;
  const std::vector<haptics::Tick> ticks = test::rehearse(bodies, start.command, kRehearsed, kRehearsed);
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  {
    SessionWriter writer(path, false, start);
    writer.write({{}, ticks, {}});
    writer.seal(0, &bodies);
  }
  const ReplayReport report = verify(path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.bone_digest, bodies.digest());
  SessionReader session(path);
  EXPECT_EQ(session.start().is_tooth, is_tooth);
  EXPECT_EQ(boneAtTime(path, {}).solid, bodies.solidInGridOrder());
  EXPECT_EQ(bodiesAt(path, 0.4).pieces(), 1u);
}

/// The tooth is in two parts from the start; the order to split it comes in the middle.
TEST(ReplayOfATooth, SplitsItAgainAtTheSameTick) {
  const test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.solid.size()), solid = block.solid;
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) {
    is_tooth[v] = ijk.x > 15 && ijk.x < 26 ? 1 : 0;
    if (ijk.x > 19 && ijk.x < 22) solid[v] = 0;
  });
  haptics::Bodies bodies(block.grid, solid, block.label, is_tooth);
  SessionStart start = block.start();
  start.is_tooth = is_tooth;
  start.solid = solid;
  haptics::Servo servo(bodies);
  haptics::Command command = start.command;
  std::vector<haptics::Tick> ticks;
  haptics::HandSample hand;
  hand.X_PT.translation_mm = {0.0, 0.0, 100.0};
  for (int n = 0; n < 50; ++n) ticks.push_back(servo.step(hand, command, start.dt_s));
  const haptics::CarvedBone& tooth = bodies.bones()[1];
  const haptics::SplitPlan plan = haptics::partingPlan({tooth.grid(), tooth.solidInGridOrder()});
  ASSERT_FALSE(plan.blocks.empty());
  command.split = {1, bodies.digest(), 0, &plan};
  ++command.serial;
  for (int n = 0; n < 200; ++n) ticks.push_back(servo.step(hand, command, start.dt_s));
  ASSERT_EQ(ticks.back().split, haptics::SplitAnswer::done);
  ASSERT_EQ(ticks.back().pieces, 2);
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  {
    SessionWriter writer(path, false, start);
    writer.write({{{command, 50}}, ticks, {}});
    writer.seal(0, &bodies);
  }
  const ReplayReport report = verify(path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.bone_digest, bodies.digest());
  EXPECT_EQ(bodiesAt(path, 0.2).pieces(), 2u);
  EXPECT_EQ(bodiesAt(path, 0.02).pieces(), 1u);
}

/// A slot with a bridge of 2 x 1 mm is there from the start; forceps twist the upper half off.
TEST(ReplayOfATooth, BreaksItsBridgeAgainByTheSamePlan) {
  const test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.solid.size()), solid = block.solid;
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) {
    is_tooth[v] = ijk.x > 15 && ijk.x < 26 && ijk.y > 8 && ijk.y < 32 ? 1 : 0;
    if (is_tooth[v] != 0 && ijk.z > 8 && ijk.z < 13 && ijk.y > 13) solid[v] = 0;
  });
  haptics::Bodies bodies(block.grid, solid, block.label, is_tooth);
  SessionStart start = block.start();
  start.is_tooth = is_tooth;
  start.solid = solid;
  start.command.tool = haptics::forcepsTool();
  haptics::Servo servo(bodies);
  const haptics::SocketSource sockets(bodies);
  const auto site = haptics::makePieceSite(sockets.scene(0, std::array<haptics::PiecePose, haptics::kMaxPieces>{}),
                                           sockets.firstSocket());
  const haptics::CarvedBone& tooth = bodies.bones()[1];
  haptics::Bridge bridge;
  bridge.area_mm2 = 2.0, bridge.width_mm = 2.0, bridge.thickness_mm = 1.0;
  bridge.half_width_mm = 1.0, bridge.half_thickness_mm = 0.5;
  // In a voxel, not on its face.
  bridge.centre_mm = block.grid.centre_P_mm({20, 11, 10}) + glm::dvec3(0.1, 0.0, 0.03);
  bridge.normal = {0.0, 0.0, 1.0}, bridge.width_axis = {1.0, 0.0, 0.0};
  const auto plan = haptics::breakPlan({tooth.grid(), tooth.solidInGridOrder()}, tooth.labelInGridOrder(), bridge);
  ASSERT_TRUE(plan);

  haptics::HandSample hand;
  hand.X_PT.translation_mm = block.grid.centre_P_mm({20, 20, 18});
  std::vector<haptics::Tick> ticks;
  std::vector<SessionCommand> commands;
  haptics::Command command = start.command;
  const auto step = [&](int count) {
    for (int n = 0; n < count; ++n) ticks.push_back(servo.step(hand, command, start.dt_s));
  };
  step(20);
  command.site = {1, bodies.digest(), 0, site.get()};
  command.bridge = {1, bodies.digest(), 0, plan->digest, plan->bridge, &*plan};
  ++command.serial;
  commands.push_back({command, ticks.size()});
  step(2);
  ASSERT_EQ(ticks.back().bridge, haptics::BreakAnswer::armed);
  hand.drill_pedal = true;
  step(1);
  ASSERT_EQ(ticks.back().gripped, 1);
  for (int n = 0; n < 400 && ticks.back().broken.piece == 0; ++n) {
    hand.X_PT.rotation = glm::angleAxis(0.002 * n, glm::dvec3(1.0, 0.0, 0.0));
    step(1);
  }
  ASSERT_EQ(ticks.back().broken.piece, 1);
  step(100);
  ASSERT_EQ(ticks.back().pieces, 2);
  const tests::ScratchFolder folder;
  const auto record = [&](const std::string& path) {
    SessionWriter writer(path, false, start);
    writer.write({commands, ticks, {}});
    writer.seal(0, &bodies);
  };
  record(folder.file("s.molar"));
  const ReplayReport report = verify(folder.file("s.molar"));
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.bone_digest, bodies.digest());
  EXPECT_EQ(bodiesAt(folder.file("s.molar"), 1.0).pieces(), 2u);
  const SessionMetrics metrics = metricsOf(folder.file("s.molar"));
  EXPECT_EQ(metrics.bridges_broken, 1.0);
  ASSERT_EQ(metrics.bridge_breaks.size(), 1u);
  EXPECT_EQ(metrics.bridge_breaks[0].area_mm2, 2.0);
  EXPECT_GT(metrics.bridge_breaks[0].bending_Nmm, 0.0);

  // Of another plan, and of no bridge at all: told, not followed.
  commands[0].command.bridge.plan_digest ^= 1;
  record(folder.file("other.molar"));
  EXPECT_NE(verify(folder.file("other.molar")).line().find("the breaking of the bridge differs"), std::string::npos);
  commands[0].command.bridge.plan_digest ^= 1;
  commands[0].command.bridge.bridge.normal = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  record(folder.file("none.molar"));
  EXPECT_FALSE(verify(folder.file("none.molar")).verified());
}

/// Orders of a stranger's file: several for one tick, and a serial that comes again. The servo sees the last of them.
TEST(ReplayOfATooth, KeepsTheSitesThatTheServoUsesWhateverTheOrders) {
  const test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.solid.size());
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) { is_tooth[v] = ijk.x > 15 && ijk.x < 26 ? 1 : 0; });
  haptics::Bodies bodies(block.grid, block.solid, block.label, is_tooth);
  const std::uint64_t digest = bodies.digest();
  SessionStart start = block.start();
  start.is_tooth = is_tooth;
  start.command.tool = haptics::forcepsTool();
  haptics::Servo servo(bodies);
  const haptics::SocketSource sockets(bodies);
  const auto site = haptics::makePieceSite(sockets.scene(0, std::array<haptics::PiecePose, haptics::kMaxPieces>{}),
                                           sockets.firstSocket());
  haptics::HandSample hand;
  hand.X_PT.translation_mm = block.grid.centre_P_mm({20, 20, 20});
  std::vector<SessionCommand> orders;
  haptics::Command command = start.command;
  const auto order = [&](std::uint64_t serial, std::uint64_t first_tick) {
    command.site = {serial, digest, 0, site.get()};
    ++command.serial;
    orders.push_back({command, first_tick});
  };
  std::vector<haptics::Tick> ticks;
  const auto step = [&](int count) {
    for (int n = 0; n < count; ++n) ticks.push_back(servo.step(hand, command, start.dt_s));
  };
  step(20);
  order(1, 20);
  step(20);
  ASSERT_EQ(ticks.back().site, haptics::SiteAnswer::ready);
  for (const std::uint64_t serial : {2, 3, 4, 1}) order(serial, 40);
  hand.drill_pedal = true;
  step(1);
  ASSERT_EQ(ticks.back().gripped, 1);
  hand.X_PT.translation_mm.z += 2.0;
  step(100);
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  {
    SessionWriter writer(path, false, start);
    writer.write({orders, ticks, {}});
    writer.seal(0, &bodies);
  }
  const ReplayReport report = verify(path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_NE(bodies.digest(), digest) << "it yields";
}

/// Nothing is recorded for it but the serials of the command.
TEST(ReplayOfATooth, UndoesAndRedoesAGrip) {
  const test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.solid.size());
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) { is_tooth[v] = ijk.x > 15 && ijk.x < 26 ? 1 : 0; });
  haptics::Bodies bodies(block.grid, block.solid, block.label, is_tooth);
  SessionStart start = block.start();
  start.is_tooth = is_tooth;
  start.command.tool = haptics::forcepsTool();
  haptics::Servo servo(bodies);
  const haptics::SocketSource sockets(bodies);
  std::vector<std::unique_ptr<haptics::PieceSite>> sites;
  haptics::HandSample hand;
  hand.X_PT.translation_mm = block.grid.centre_P_mm({20, 20, 20});
  std::vector<haptics::Tick> ticks;
  std::vector<SessionCommand> commands;
  haptics::Command command = start.command;
  const auto step = [&](int count) {
    for (int n = 0; n < count; ++n) ticks.push_back(servo.step(hand, command, start.dt_s));
  };
  const auto give = [&] {
    ++command.serial;
    commands.push_back({command, ticks.size()});
    step(20);
  };
  const auto makeReady = [&] {
    sites.push_back(haptics::makePieceSite(sockets.scene(0, ticks.back().X_PQ), sockets.firstSocket()));
    command.site = {command.site.serial + 1, bodies.digest(), 0, sites.back().get()};
    give();
    ASSERT_EQ(ticks.back().site, haptics::SiteAnswer::ready);
  };
  const auto pull = [&](double mm) {
    hand.drill_pedal = true;
    step(2);
    ASSERT_EQ(ticks.back().gripped, 1);
    hand.X_PT.translation_mm.z += mm;
    step(200);
    hand.X_PT.translation_mm.z -= mm;
    step(200);
    hand.drill_pedal = false;
    step(400);
  };
  step(20);
  const std::uint64_t first = bodies.digest();
  makeReady();
  pull(3.0);
  const std::uint64_t pulled = bodies.digest();
  ASSERT_NE(pulled, first);
  ++command.undo_serial, give();
  EXPECT_EQ(bodies.digest(), first);
  ++command.redo_serial, give();
  EXPECT_EQ(bodies.digest(), pulled);
  makeReady();
  ++command.undo_serial, give();
  EXPECT_EQ(ticks.back().undone_strokes, 1);
  // Gripped again by what was put back.
  pull(2.0);
  EXPECT_NE(bodies.digest(), pulled);
  EXPECT_EQ(ticks.back().strokes, 1);
  EXPECT_EQ(ticks.back().undone_strokes, 0);
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  {
    SessionWriter writer(path, false, start);
    writer.write({commands, ticks, {}});
    writer.seal(0, &bodies);
  }
  const ReplayReport report = verify(path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.bone_digest, bodies.digest());
}

}  // namespace
}  // namespace app
