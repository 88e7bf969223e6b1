#include "app/session/session_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "app/session/session_error.h"
#include "app/session/session_writer.h"
#include "haptics/body/piece_split.h"
#include "haptics/ligament/piece_site.h"
#include "haptics/servo/servo.h"
#include "tests/app/session/real_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr double kDt_s = 0.01;

/// A session made tick by tick by a servo.
class Recording {
 public:
  Recording(const test::BoneBlock& block, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> is_tooth)
      : bodies(block.grid, solid, block.label, is_tooth), servo_(bodies) {
    SessionStart start = block.start();
    start.dt_s = kDt_s;
    start.solid = solid;
    start.is_tooth = is_tooth;
    command = start.command;
    writer_.emplace(path, false, start);
  }

  void step(int count) {
    for (int n = 0; n < count; ++n) {
      batch_.ticks.push_back(servo_.step(hand, command, kDt_s));
      ticks.push_back(batch_.ticks.back());
      if (batch_.ticks.size() == 50) write();
    }
  }
  /// From the next tick on.
  void give() {
    ++command.serial;
    batch_.commands.push_back({command, ticks.size()});
  }
  void close() {
    write();
    writer_->seal(0, &bodies);
    writer_.reset();
  }

  tests::ScratchFolder folder;
  std::string path = folder.file("s.molar");
  haptics::Bodies bodies;
  haptics::Command command;
  haptics::HandSample hand;
  std::vector<haptics::Tick> ticks;

 private:
  void write() {
    writer_->write(batch_);
    batch_ = {};
  }
  haptics::Servo servo_;
  std::optional<SessionWriter> writer_;
  SessionBatch batch_;
};

/// Cuts, undoes and redoes at random, as each of `operations` says.
void workAtRandom(Recording& session, int operations, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-3.0, 3.0), depth(0.4, 0.9);
  for (int n = 0; n < operations; ++n) {
    const std::uint64_t kind = random() % 10;
    if (kind < 5) {
      const double x_mm = place(random), y_mm = place(random), z_mm = depth(random);
      session.hand.drill_pedal = true;
      for (int tick = 0; tick < 8; ++tick) {
        session.hand.X_PT.translation_mm = {x_mm + 0.1 * tick, y_mm, z_mm};
        session.step(1);
      }
    } else if (kind < 9) {
      ++(kind < 8 ? session.command.undo_serial : session.command.redo_serial);
      session.give();
    } else {
      session.command.tool.head.radius_mm = 0.6 + 0.1 * static_cast<double>(random() % 6);
      session.give();
    }
    session.hand.drill_pedal = false;
    session.hand.X_PT.translation_mm = {0.0, 0.0, 6.0};
    session.step(kind < 5 ? 33 : 6);
  }
}

TEST(SessionMoments, AfterAThousandMixedOperationsAreThoseOfAFreshRun) {
  const test::BoneBlock block;
  Recording session(block, block.solid, {});
  std::mt19937_64 random(20261127);
  workAtRandom(session, 1000, random);
  std::size_t undone = 0, redone = 0;
  for (std::size_t n = 1; n < session.ticks.size(); ++n) {
    undone += session.ticks[n].undone_strokes > session.ticks[n - 1].undone_strokes ? 1 : 0;
    redone += session.ticks[n].undone_strokes < session.ticks[n - 1].undone_strokes &&
                      session.ticks[n].strokes > session.ticks[n - 1].strokes
                  ? 1
                  : 0;
  }
  ASSERT_GT(undone, 100u);
  ASSERT_GT(redone, 30u);
  session.close();

  SessionMoments moments(session.path, {5.0, std::size_t{512} << 20});
  while (moments.index(20.0)) {
  }
  EXPECT_FALSE(moments.difference());
  ASSERT_GT(moments.keyframes(), 40u);
  EXPECT_EQ(moments.bodies().digest(), session.bodies.digest());
  std::uniform_real_distribution<double> anywhere(-1.0, moments.length_s() + 1.0);
  for (int n = 0; n < 60; ++n) {
    const double t_s = anywhere(random);
    moments.goTo(t_s);
    const auto last = std::ranges::find_if(session.ticks, [&](const haptics::Tick& tick) { return tick.t_s >= t_s; });
    const auto ran = static_cast<std::size_t>(last - session.ticks.begin());
    ASSERT_EQ(moments.bodies().digest(), ran == 0 ? haptics::Bodies(block.grid, block.solid, block.label).digest()
                                                  : session.ticks[ran - 1].bone_digest)
        << t_s;
    if (ran > 0) {
      EXPECT_FALSE(differenceOf(session.ticks[ran - 1], moments.tick())) << t_s;
    }
  }
  // Near it is at a keyframe, and from there the way goes on as from any moment.
  for (int n = 0; n < 30; ++n) {
    const double t_s = anywhere(random);
    moments.goNear(t_s);
    const auto near = std::ranges::find_if(
        session.ticks, [&](const haptics::Tick& tick) { return tick.index == moments.tick().index; });
    ASSERT_NE(near, session.ticks.end());
    if (moments.tick().dt_s > 0.0) {
      EXPECT_EQ(moments.bodies().digest(), near->bone_digest) << t_s;
    }
    // Half of the time between two, to whole blocks; behind the last one all of it.
    constexpr double kBetween_s = 5.0 + 50 * kDt_s;
    const double most_s = t_s > moments.length_s() - kBetween_s ? kBetween_s : 0.5 * kBetween_s + kDt_s;
    EXPECT_LE(std::abs(moments.tick().t_s - std::clamp(t_s, 0.0, moments.length_s())), most_s) << t_s;
    if (n % 3 == 0) {
      const double on_s = std::min(moments.tick().t_s + 1.0, moments.length_s());
      moments.goTo(on_s);
      const auto last =
          std::ranges::find_if(session.ticks, [&](const haptics::Tick& tick) { return tick.t_s >= on_s; });
      EXPECT_FALSE(differenceOf(*(last - 1), moments.tick())) << on_s;
    }
  }
  SessionReader again(session.path);
  moments.goTo(100.0);
  const ReplayedState fresh = replayTo(again, 100.0);
  EXPECT_EQ(moments.bodies().digest(), fresh.bodies.digest());
  EXPECT_EQ(moments.bodies().solidInMouth(), fresh.bodies.solidInMouth());
  EXPECT_EQ(moments.bodies().removedByTissue_mm3(), fresh.bodies.removedByTissue_mm3());
}

TEST(SessionMoments, InLittleMemoryDropKeyframesNotMoments) {
  const test::BoneBlock block;
  Recording session(block, block.solid, {});
  std::mt19937_64 random(5);
  workAtRandom(session, 150, random);
  session.close();
  SessionMoments all(session.path, {0.5, std::size_t{512} << 20}), few(session.path, {0.5, 0});
  while (all.index(20.0)) {
  }
  while (few.index(20.0)) {
  }
  EXPECT_GT(all.keyframes(), 60u);
  EXPECT_LE(few.keyframes(), 4u);
  EXPECT_LT(few.keyframeBytes(), all.keyframeBytes());
  std::uniform_real_distribution<double> anywhere(0.0, all.length_s());
  for (int n = 0; n < 20; ++n) {
    const double t_s = anywhere(random);
    all.goTo(t_s), few.goTo(t_s);
    ASSERT_EQ(all.bodies().digest(), few.bodies().digest()) << t_s;
  }
}

TEST(SessionMoments, TellTheBricksThatAJumpChanges) {
  const test::BoneBlock block;
  Recording session(block, block.solid, {});
  std::mt19937_64 random(6);
  workAtRandom(session, 30, random);
  session.close();
  SessionMoments moments(session.path);
  while (moments.index(20.0)) {
  }
  // As a renderer sees it: bricks that are told, and nothing else.
  std::vector<std::uint8_t> seen = block.solid;
  std::uniform_real_distribution<double> anywhere(0.0, moments.length_s());
  for (int n = 0; n < 20; ++n) {
    moments.goTo(anywhere(random));
    for (const glm::ivec3& brick : moments.takeChangedBricks()) {
      std::array<std::uint8_t, 512> solid{};
      moments.bodies().jaw().copyBrick(brick, solid);
      assets::forVoxels(glm::ivec3(0), glm::ivec3(8), [&](glm::ivec3 at) {
        const glm::ivec3 ijk = brick * 8 + at;
        if (block.grid.contains(ijk)) seen[block.grid.index(ijk)] = solid[assets::indexIn(glm::ivec3(8), at)];
      });
    }
    ASSERT_EQ(seen, moments.bodies().solidInGridOrder());
  }
}

/// A tooth in two halves that is split, of which one is gripped, moved, put back and moved again.
TEST(SessionMoments, OfATooth) {
  const test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.solid.size()), solid = block.solid;
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) {
    is_tooth[v] = ijk.x > 12 && ijk.x < 29 ? 1 : 0;
    if (ijk.x > 19 && ijk.x < 22) solid[v] = 0;
  });
  Recording session(block, solid, is_tooth);
  const haptics::SocketSource sockets(session.bodies);
  std::vector<std::unique_ptr<haptics::PieceSite>> sites;
  session.hand.X_PT.translation_mm = {0.0, 0.0, 100.0};
  session.step(20);
  const haptics::CarvedBone& tooth = session.bodies.bones()[1];
  const haptics::SplitPlan plan = haptics::partingPlan({tooth.grid(), tooth.solidInGridOrder()});
  session.command.split = {1, session.bodies.digest(), 0, &plan};
  session.give();
  session.step(200);
  ASSERT_EQ(session.ticks.back().pieces, 2);
  session.command.tool = haptics::forcepsTool();
  session.give();
  const glm::dvec3 grip_P_mm = block.grid.centre_P_mm({16, 20, 20});
  for (const double above_mm : {20.0, 10.0, 5.0, 2.0, 1.0}) {
    session.hand.X_PT.translation_mm = grip_P_mm + glm::dvec3(0.0, 0.0, above_mm);
    session.step(20);
  }
  for (int n = 0; n < 4; ++n) {
    std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ;
    for (std::size_t piece = 0; piece < X_PQ.size(); ++piece) X_PQ[piece] = session.bodies.pose(piece);
    sites.push_back(haptics::makePieceSite(sockets.scene(0, X_PQ), sockets.firstSocket()));
    session.command.site = {session.command.site.serial + 1, session.bodies.digest(), 0, sites.back().get()};
    session.give();
    session.hand.X_PT.translation_mm = grip_P_mm;
    session.step(20);
    ASSERT_EQ(session.ticks.back().site, haptics::SiteAnswer::ready);
    session.hand.drill_pedal = true;
    session.step(2);
    ASSERT_EQ(session.ticks.back().gripped, 1) << n;
    for (int tick = 0; tick < 40; ++tick) {
      session.hand.X_PT.translation_mm.z += tick < 25 ? 0.08 : -0.05;
      session.step(1);
    }
    session.hand.drill_pedal = false;
    session.step(60);
    if (n % 2 == 0) continue;
    ++session.command.undo_serial;
    session.give();
    session.step(20);
  }
  session.close();
  SessionMoments moments(session.path, {0.7, std::size_t{512} << 20});
  while (moments.index(1.0)) {
  }
  EXPECT_FALSE(moments.difference()) << moments.difference()->what;
  EXPECT_EQ(moments.bodies().digest(), session.bodies.digest());
  std::mt19937_64 random(3);
  for (int n = 0; n < 80; ++n) {
    const std::size_t ran = 1 + random() % session.ticks.size();
    const haptics::Tick& last = session.ticks[ran - 1];
    moments.goTo(last.t_s + 0.5 * kDt_s);
    ASSERT_EQ(moments.bodies().digest(), last.bone_digest) << ran;
    ASSERT_FALSE(differenceOf(last, moments.tick())) << ran << *differenceOf(last, moments.tick());
  }
}

TEST(SessionMoments, RefuseADamagedSession) {
  const test::BoneBlock block;
  Recording session(block, block.solid, {});
  session.step(200);
  session.close();
  std::string bytes = test::bytesOf(session.path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  test::writeBytes(session.path, bytes);
  EXPECT_THROW(SessionMoments moments(session.path), SessionError);
}

}  // namespace
}  // namespace app
