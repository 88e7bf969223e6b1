// What broken files leave in a tooth: told by a session whoever records it, there again when it is gone on from.
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/session/fragment_trail.h"
#include "app/session/fragments_event.h"
#include "app/session/replay.h"
#include "app/session/session_writer.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/file_scene.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

std::vector<assets::MetalFragment> twoFragments() {
  assets::MetalFragment steel{20, false, {{1.0, 2.0, 3.0}, {1.1, 2.0, 2.25}, {1.3, 2.0, 1.5}}, {0.2, 0.19, 0.17}};
  assets::MetalFragment other{15, true, {{0.0, 0.0, 0.0}, {0.0, 0.0, -0.7}}, {0.1, 0.08}};
  return {steel, other};
}

TEST(FragmentsText, ComesBackAsItWas) {
  EXPECT_EQ(fragmentsFrom(fragmentsText(twoFragments())), twoFragments());
  EXPECT_TRUE(fragmentsFrom(fragmentsText({})).empty());
}

TEST(FragmentsText, RefusesWhatCannotBe) {
  const nlohmann::json good = nlohmann::json::parse(fragmentsText(twoFragments()));
  const auto refused = [&](const auto& damage) {
    nlohmann::json bad = good;
    damage(bad);
    EXPECT_THROW(fragmentsFrom(bad.dump()), SessionError) << bad.dump().substr(0, 200);
  };
  refused([](auto& j) { j = nlohmann::json::object(); });
  refused([](auto& j) { j[0] = 1; });
  refused([](auto& j) { j[0]["size"] = 0; });
  refused([](auto& j) { j[0]["size"] = 2.5; });
  refused([](auto& j) { j[0].erase("nickel_titanium"); });
  refused([](auto& j) { j[0]["nodes"].erase(1), j[0]["nodes"].erase(1); });
  refused([](auto& j) { j[0]["nodes"][0][3] = -0.1; });
  refused([](auto& j) { j[0]["nodes"][0][0] = 1e9; });
  refused([](auto& j) { j[0]["nodes"][0] = "x"; });
  refused([](auto& j) {
    while (j[0]["nodes"].size() <= assets::kMostMetalNodes) j[0]["nodes"].push_back(j[0]["nodes"][0]);
  });
  refused([](auto& j) {
    while (j.size() <= assets::kMostMetalFragments) j.push_back(j[0]);
  });
  EXPECT_THROW(fragmentsFrom(""), SessionError);
}

/// Any byte changed: it is read as it stands, or refused in one line.
TEST(FragmentsText, ReadsNoDamageAsSomethingElse) {
  const std::string good = fragmentsText(twoFragments());
  std::mt19937 random(11);
  int read = 0, refused = 0;
  for (int n = 0; n < 5000; ++n) {
    std::string text = good;
    for (int k = 0; k <= n % 3; ++k) text[random() % text.size()] = static_cast<char>(32 + random() % 95);
    try {
      const auto fragments = fragmentsFrom(text);
      EXPECT_EQ(fragmentsFrom(fragmentsText(fragments)), fragments);
      ++read;
    } catch (const SessionError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, 100);
}

TEST(FragmentTrail, ATickGivesWhatBrokeOffAndAnUndoTakesItBack) {
  const haptics::CanalFile file{25, 25.0};
  haptics::Tick tick;
  for (std::size_t n = 0; n < tick.file.node_P_mm.size(); ++n)
    tick.file.node_P_mm[n] = {0.0f, 0.0f, -25.0f * static_cast<float>(n) / 32.0f};
  // At node 28: four links of 25 / 32 mm are left in.
  tick.file.broken_from_tip_mm = 4.0 * 25.0 / 32.0;
  tick.file.fragments = 1;
  FragmentTrail trail(twoFragments());
  EXPECT_EQ(trail.lying().size(), 2u);
  tick.file.fragments = 3;
  EXPECT_TRUE(trail.follow(tick, file));
  ASSERT_EQ(trail.lying().size(), 3u);
  const assets::MetalFragment& left = trail.lying().back();
  EXPECT_NEAR(left.length_mm(), 3.125, 1e-5);
  EXPECT_EQ(left.node_P_mm.size(), 5u);
  EXPECT_NEAR(left.tip_P_mm().z, -25.0, 1e-5);
  // ISO 3630-1: 0.25 mm at the tip, 0.02 more a millimetre.
  EXPECT_NEAR(left.radius_mm.back(), 0.125, 1e-9);
  EXPECT_NEAR(left.radius_mm.front(), 0.5 * (0.25 + 0.02 * 3.125), 1e-9);

  tick.file.broken_from_tip_mm = 0.0;
  EXPECT_FALSE(trail.follow(tick, file));
  tick.file.fragments = 2;
  EXPECT_TRUE(trail.follow(tick, file));
  EXPECT_EQ(trail.lying().size(), 2u);
  tick.file.fragments = 3;
  EXPECT_TRUE(trail.follow(tick, file)) << "redone";
  EXPECT_EQ(trail.lying().back(), left);
}

/// A servo on a tooth, a file in the hand, and the recording of it.
struct BrokenFile {
  haptics::phantom::CanalWall canal{haptics::phantom::bentCanal(0.7)};
  haptics::HandSample hand;
  haptics::Command command;
  haptics::Tick tick;
  SessionBatch batch;

  BrokenFile() {
    command.serial = 1;
    command.safety.must_be_armed = false;
    hand.held = hand.fresh = hand.calibrated = hand.device_healthy = true;
    hand.X_PT.translation_mm = {0.0, 0.0, 21.5};
  }
  void take(std::uint64_t size, const haptics::Tick& newest) {
    hand.X_PT = {};
    hand.X_PT.translation_mm = {0.0, 0.0, 21.5};
    command.tool = haptics::fileTool({size, 21.0});
    ++command.serial;
    batch.commands.push_back({command, newest.dt_s > 0.0 ? newest.index + 1 : 0});
  }
  void move(haptics::Servo& servo, double down_mm, double turn_rad = 0.0) {
    hand.X_PT.translation_mm.z -= down_mm;
    hand.X_PT.rotation = glm::normalize(hand.X_PT.rotation * glm::angleAxis(turn_rad, glm::dvec3(0.0, 0.0, -1.0)));
    tick = servo.step(hand, command, 1e-3);
    batch.ticks.push_back(tick);
  }
  void to(haptics::Servo& servo, double deep_mm, double step_mm) {
    while ((21.0 - hand.X_PT.translation_mm.z - deep_mm) * step_mm < 0.0) move(servo, step_mm);
  }
  SessionStart start() const {
    SessionStart begun;
    begun.grid = canal.field.grid;
    begun.solid = canal.field.solid;
    begun.command = command;
    return begun;
  }
};

TEST(Fragments, AreInTheSessionAndStopFilesOfTheNextOne) {
  const tests::ScratchFolder folder;
  BrokenFile at;
  haptics::Bodies bodies(at.canal.field.grid, at.canal.field.solid, {});
  haptics::Servo servo(bodies);
  at.command.tool = haptics::fileTool({25, 21.0});
  SessionWriter writer(folder.file("first.molar"), false, at.start());
  at.to(servo, 15.3, 0.01);
  for (int n = 0; n < 3000 && at.tick.file.broken_from_tip_mm == 0.0; ++n) at.move(servo, 0.0, 0.029);
  ASSERT_GT(at.tick.file.broken_from_tip_mm, 0.0);
  const double break_mm = at.canal.canal.nearest_mm(at.tick.file.tip_P_mm);
  const std::uint64_t broke_at = at.tick.index;
  at.to(servo, -0.5, -0.03);
  // Undone and redone.
  for (const bool redoes : {false, true}) {
    for (int n = 0; n < 20 && (at.tick.file.fragments > 0) != redoes; ++n) {
      ++(redoes ? at.command.redo_serial : at.command.undo_serial);
      ++at.command.serial;
      at.batch.commands.push_back({at.command, at.tick.index + 1});
      for (int wait = 0; wait < 200; ++wait) at.move(servo, 0.0);
    }
    EXPECT_EQ(at.tick.file.fragments, redoes ? 1 : 0);
  }
  writer.write(at.batch);
  writer.seal(0, &bodies);

  SessionReader session(folder.file("first.molar"));
  const std::vector<SessionEvent> events = session.events();
  ASSERT_EQ(events.size(), 3u) << "broken, undone, redone";
  EXPECT_EQ(events[0].kind, kFragmentsEvent);
  EXPECT_EQ(events[0].tick, broke_at);
  const auto left = fragmentsIn({}, events);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].size, 25);
  EXPECT_EQ(left, fragmentsFrom(events[0].text));
  EXPECT_TRUE(fragmentsIn({}, events, broke_at - 1).empty());
  EXPECT_EQ(fragmentsIn({}, events, broke_at).size(), 1u);
  EXPECT_TRUE(verify(folder.file("first.molar")).verified());
  const BoneAtTime end = boneAtTime(folder.file("first.molar"), {});
  EXPECT_EQ(end.fragments, left);

  // Gone on from: a thin file comes to the break and no farther, and a replay of it has the same bits.
  BrokenFile next;
  haptics::Bodies later(at.canal.field.grid, end.solid, {});
  later.leave(end.fragments);
  haptics::Servo later_servo(later);
  SessionStart begun = next.start();
  begun.solid = end.solid;
  begun.setup.fragments = end.fragments;
  next.command.tool = haptics::fileTool({10, 21.0});
  begun.command = next.command;
  {
    SessionWriter second(folder.file("second.molar"), false, begun);
    next.to(later_servo, break_mm + 1.5, 0.01);
    EXPECT_EQ(next.tick.file.fragments, 1);
    EXPECT_LT(next.canal.canal.nearest_mm(next.tick.file.tip_P_mm), break_mm + 0.4) << "held by the fragment";
    second.write(next.batch);
    second.seal(0, &later);
  }
  const ReplayReport report = verify(folder.file("second.molar"));
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(boneAtTime(folder.file("second.molar"), {}).fragments, end.fragments);
}

}  // namespace
}  // namespace app
