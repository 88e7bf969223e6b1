#include "app/session/replay.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "app/session/measures/practice_measures.h"
#include "app/session/metrics.h"
#include "app/session/session_error.h"
#include "app/session/session_writer.h"
#include "tests/app/session/real_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr std::size_t kTicks = 900, kChange = 500;

ReplayedState momentOf(const std::string& path, double t_s) {
  SessionReader session(path);
  refuseDamaged(session, path);
  return replayTo(session, t_s);
}

/// One recorded rehearsal and the bone it left.
struct Recorded {
  tests::ScratchFolder folder;
  std::string path = folder.file("s.molar");
  test::BoneBlock block;
  haptics::Bodies bone{block.grid, block.solid, block.label};
  std::vector<haptics::Tick> ticks = test::rehearse(bone, block.start().command, kTicks, kChange);

  ServoBuild servo = thisServo();

  /// Writes `ticks` as they are now.
  void write(bool closed = true, std::uint64_t lost = 0) {
    SessionStart start = block.start();
    start.servo = servo;
    SessionWriter writer(path, true, start);
    const auto change = ticks.begin() + static_cast<std::ptrdiff_t>(std::min(kChange, ticks.size()));
    writer.write({{}, {ticks.begin(), change}, {}});
    writer.write({{{test::largerBur(block.start().command), kChange}}, {change, ticks.end()}, {{1, "note", "x"}}});
    if (closed) writer.seal(lost, &bone);
  }
};

TEST(Replay, FindsARehearsalIdentical) {
  Recorded session;
  ASSERT_GT(session.ticks[kTicks - 1].law_force_P_N.xyz.z + session.ticks[100].law_force_P_N.xyz.z, 0.0);
  session.write();
  const ReplayReport report = verify(session.path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.replayed, kTicks);
  EXPECT_NEAR(report.duration_s, 0.9, 1e-9);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.bone_digest, session.bone.digest());
}

TEST(Replay, FindsARehearsalOfEveryLawHeadAndShaftIdentical) {
  // Law, head, shaft and stiffness change every 80 ticks while the tool is in the bone.
  constexpr std::size_t kEach = 80;
  const test::BoneBlock block;
  haptics::Bodies bone(block.grid, block.solid, block.label);
  haptics::Servo servo(bone);
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  SessionWriter writer(path, true, block.start());
  std::size_t with_torque = 0;
  for (std::size_t part = 0; part < 14; ++part) {
    haptics::Command command = block.start().command;
    command.serial = part + 1;
    command.law.kind = haptics::kLaws[part % haptics::kLaws.size()].kind;
    command.law.agus.stiffness_N_per_mm = 0.5 + 0.1 * static_cast<double>(part);
    if (part > 0)
      command.tool.head = {static_cast<haptics::ShapeKind>(part % haptics::kShapeKinds), 0.8, 1.5,
                           part % 2 == 0 ? assets::BurProfile::torpedo : assets::BurProfile::pear};
    if (part % 2 == 1) command.tool.shaft = {0.4, 6.0};
    std::vector<haptics::Tick> ticks;
    for (std::size_t n = part * kEach; n < (part + 1) * kEach; ++n) {
      haptics::HandSample hand = test::sweepingHand(static_cast<double>(n) * 0.001);
      hand.X_PT.rotation = glm::normalize(glm::dquat(1.0, 0.3, 0.2 * std::sin(0.01 * static_cast<double>(n)), 0.0));
      hand.arm_P_mm.xyz = hand.X_PT.rotation * glm::dvec3(0.0, 0.0, 40.0);
      const haptics::Command& obeyed = part == 0 ? block.start().command : command;
      ticks.push_back(servo.step(hand, obeyed, 0.001));
      with_torque += glm::length(ticks.back().commanded_torque_P_Nmm.xyz) > 1.0 ? 1 : 0;
    }
    if (part == 0)
      writer.write({{}, ticks, {}});
    else
      writer.write({{{command, part * kEach}}, ticks, {}});
  }
  writer.seal(0);
  EXPECT_GT(with_torque, kEach);
  const ReplayReport report = verify(path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.replayed, 14 * kEach);
}

/// Drills three strokes, half a second apart, the second of them dry, then takes back the last two: 2.4 s.
struct RecordedUndo {
  tests::ScratchFolder folder;
  std::string path = folder.file("s.molar");
  test::BoneBlock block;
  haptics::Bodies bone{block.grid, block.solid, block.label};
  double dry_s = 0.0, cut_mm3 = 0.0, returned_mm3 = 0.0;
  std::uint64_t digest_after_first = 0;

  explicit RecordedUndo(bool closes = true) {
    haptics::Servo servo(bone);
    haptics::Command command = block.start().command;
    SessionWriter writer(path, true, block.start());
    for (std::size_t n = 0; n < 2400; ++n) {
      const double t_s = static_cast<double>(n) * 0.001;
      SessionBatch batch;
      const bool undoes = n == 1700 || n == 1900;
      if (n == 600 || n == 1200) command.irrigating = !command.irrigating;
      if (undoes) ++command.undo_serial;
      if (undoes || n == 600 || n == 1200) {
        ++command.serial;
        batch.commands.push_back({command, n});
      }
      haptics::HandSample hand = test::sweepingHand(t_s);
      hand.drill_pedal = n < 1800 && std::fmod(t_s, 0.6) < 0.15;
      batch.ticks.push_back(servo.step(hand, command, 0.001));
      const haptics::Tick& tick = batch.ticks.back();
      if (n == 400) digest_after_first = tick.bone_digest;
      if (tick.drilling && tick.overlap_mm3 > 0.0 && n >= 600 && n < 1200) dry_s += 0.001;
      (tick.removed_mm3 < 0.0 ? returned_mm3 : cut_mm3) += std::abs(tick.removed_mm3);
      writer.write(batch);
    }
    if (closes) writer.seal(0, &bone);
  }
};

TEST(Replay, FindsARehearsalWithUndoneStrokesIdentical) {
  RecordedUndo session;
  EXPECT_EQ(session.bone.digest(), session.digest_after_first);
  const ReplayReport report = verify(session.path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.replayed, 2400u);
  EXPECT_EQ(report.bone_digest, session.bone.digest());
}

SessionCase noCase(const StoredStart&) { return {}; }

TEST(Metrics, EachMeasureHasAnIdOfItsOwn) {
  const RecordedUndo session;
  std::set<std::string_view> ids;
  for (const MeasureValue& measure : metricsOf(session.path, noCase).measures) {
    EXPECT_TRUE(ids.insert(measure.id).second) << measure.id;
    EXPECT_TRUE(measure.value || !measure.why.empty()) << measure.id;
  }
  EXPECT_GT(ids.size(), 80U);
  for (const Measure& measure : kMeasures) EXPECT_TRUE(ids.insert(measure.key).second) << measure.key;
  const assets::VolumeGrid grid{{4, 4, 4}, 0.5, glm::dvec3(0.0)};
  const std::vector<std::uint8_t> bytes(64);
  for (std::size_t task = 0; task < assets::kPracticeTasks.size(); ++task) {
    std::set<std::string_view> all = ids;
    for (const MeasureValue& measure :
         practiceMeasures(static_cast<assets::PracticeTask>(task), grid, bytes, bytes, bytes))
      EXPECT_TRUE(all.insert(measure.id).second) << measure.id;
  }
}

TEST(Metrics, OfAnUnclosedRecordingTakeTheBoneThatIsAtHand) {
  const RecordedUndo session(false);
  SessionReader reader(session.path);
  BoneLeft left = boneLeft(reader, reader.start());
  EXPECT_TRUE(left.removed_mm3) << "it took a replay";
  EXPECT_EQ(left.solid, session.bone.solidInMouth());
  EXPECT_EQ(metricsJson(metricsOf(session.path, noCase, &left)), metricsJson(metricsOf(session.path, noCase)));
  left.divergence = ReplayDifference{3, "the force served differs"};
  const SessionMetrics metrics = metricsOf(session.path, noCase, &left);
  EXPECT_EQ(measureOf(metrics, "O5.area")->why, "the bone at the end is not known");
  EXPECT_EQ(measureOf(metrics, "no such"), nullptr);
}

TEST(Metrics, TellWhatWasDrilledDryAndWhatWasTakenBack) {
  RecordedUndo session;
  const SessionMetrics metrics = metricsOf(session.path);
  EXPECT_GT(session.dry_s, 0.05);
  EXPECT_NEAR(metrics.dry_drilling_s, session.dry_s, 1e-9);
  EXPECT_GT(metrics.drill_in_contact_s, metrics.dry_drilling_s + 0.05);
  EXPECT_LE(metrics.obscured_s, metrics.drill_in_contact_s);
  EXPECT_GT(session.returned_mm3, 0.05);
  EXPECT_NEAR(metrics.returned_mm3, session.returned_mm3, 1e-9);
  EXPECT_NEAR(metrics.removed_mm3, session.cut_mm3 - session.returned_mm3, 1e-9);
  EXPECT_NEAR(metrics.removed_mm3_by_label->at("cortical"), metrics.removed_mm3, 1e-6);
  const std::string json = metricsJson(metrics), words = metricsText(metrics);
  EXPECT_NE(json.find("\"dry_drilling_s\": 0."), std::string::npos) << json;
  EXPECT_NE(words.find("without irrigation"), std::string::npos) << words;
  EXPECT_NE(words.find("mm³ undone"), std::string::npos) << words;
  const std::string brief = metricsInShort(metrics);
  EXPECT_EQ(brief.find("0:02 min, "), 0u) << brief;
  EXPECT_NE(brief.find(" mm³ removed; 0."), std::string::npos) << brief;
  EXPECT_NE(brief.find(" s without water."), std::string::npos) << brief;
}

TEST(Replay, TripsAsTheRehearsalDid) {
  const test::BoneBlock block;
  haptics::Bodies bone(block.grid, block.solid, block.label);
  haptics::Servo servo(bone);
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  SessionStart start = block.start();
  start.command.safety = haptics::strict(start.command.safety);
  start.command.safety.continuous_force_N = 0.3;
  start.command.safety.peak_joint_torque_Nmm = glm::dvec3(40.0);
  SessionWriter writer(path, true, start);
  haptics::Fault seen = haptics::Fault::none;
  for (std::size_t part = 0; part < 4; ++part) {
    haptics::Command command = start.command;
    command.serial = part + 1;
    command.rearm = part;
    std::vector<haptics::Tick> ticks;
    for (std::size_t n = 0; n < 1200; ++n) {
      // Above the bone until the force is on, then into it; in each part something else goes wrong.
      const double t = static_cast<double>(n) * 0.001;
      haptics::HandSample hand = test::sweepingHand(t);
      hand.X_PT.translation_mm.z = 0.5 + 2.5 * std::max(0.0, 0.8 - t) / 0.8;
      hand.velocity_P_mm_per_s.xyz = {18.0 * std::cos(9.0 * t), 0.0, n < 800 ? -3.0 : 0.0};
      hand.handle_velocity_P_mm_per_s = hand.velocity_P_mm_per_s;
      hand.jacobian_P_mm = glm::dmat3(120.0);
      hand.motor_heat = part == 1 && n > 900 ? 0.9 : 0.1;
      hand.fresh = n < 1000 || n > 1000 + 8 * (part + 1);
      hand.held = part != 1 || n < 950;
      if (part == 2 && n == 900) hand.X_PT.translation_mm.x = std::nan("");
      if (part == 2 && n == 1100) hand.gap_s = 0.5;
      if (part == 3 && n > 1100) hand.stop_requested = true;
      ticks.push_back(servo.step(hand, command, 0.001));
      seen = seen | ticks.back().faults;
    }
    if (part == 0)
      writer.write({{}, ticks, {}});
    else
      writer.write({{{command, part * 1200}}, ticks, {}});
  }
  writer.seal(0);
  using haptics::Fault;
  for (Fault one : {Fault::bad_pose, Fault::joints, Fault::hot, Fault::stale, Fault::resumed, Fault::let_go,
                    Fault::latched, Fault::stopped})
    EXPECT_TRUE(has(seen, one)) << static_cast<std::uint32_t>(one);
  const ReplayReport report = verify(path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.replayed, 4u * 1200u);
}

TEST(Replay, NamesTheFirstTickWhoseForceDiffersByOneBit) {
  Recorded session;
  double& force_N = session.ticks[321].commanded_force_P_N.xyz.z;
  force_N = std::nextafter(force_N, 10.0);
  session.ticks[400].depth_mm += 1.0;
  session.write();
  const ReplayReport report = verify(session.path);
  EXPECT_FALSE(report.verified());
  ASSERT_TRUE(report.difference.has_value());
  EXPECT_EQ(report.difference->tick, 321u);
  EXPECT_EQ(report.difference->what, "the force served differs");
  EXPECT_EQ(report.replayed, 321u);
  EXPECT_EQ(report.ticks, kTicks);
}

TEST(Replay, NoticesEveryQuantityOfATick) {
  const auto changed = [](auto&& change) {
    Recorded session;
    change(session.ticks[10]);
    session.write();
    const ReplayReport report = verify(session.path);
    return report.difference ? report.difference->tick : kTicks;
  };
  using haptics::Tick;
  EXPECT_EQ(changed([](Tick&) {}), kTicks);
  EXPECT_EQ(changed([](Tick& t) { t.work_us += 1.0f; }), kTicks) << "CPU time is not replayed";
  EXPECT_EQ(changed([](Tick& t) { t.t_s += 1e-15; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.law_torque_P_Nmm.xyz.x += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.commanded_torque_P_Nmm.xyz.z += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.energy_Nmm += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.spindle_rad_per_s += 1e-9; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.hand.X_PT.translation_mm.z -= 1e-9; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.proxy_P.mm.x += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.law_force_P_N.xyz.y += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.overlap_mm3 += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.depth_mm += 1e-12; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.removed_mm3 += 1e-15; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.bone_digest ^= 1; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.contact_tissue ^= 1; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.drilling = !t.drilling; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.drill_inhibit = haptics::DrillInhibit::tool_embedded; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { ++t.strokes; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.faults = t.faults | haptics::Fault::device; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.state = haptics::SafetyState::ready; }), 10u);
  EXPECT_EQ(changed([](Tick& t) { t.command_serial = 9; }), 10u);
}

TEST(Replay, StartsFromTheRecordedBone) {
  Recorded session;
  // One voxel under the bur, one grey step less than the hand felt.
  session.block.solid[session.block.grid.index({20, 22, 18})] -= 1;
  session.write();
  EXPECT_FALSE(verify(session.path).verified());
}

TEST(Replay, SaysWhereTicksWereLost) {
  Recorded session;
  session.ticks.erase(session.ticks.begin() + 200, session.ticks.begin() + 207);
  session.write();
  const ReplayReport report = verify(session.path);
  EXPECT_FALSE(report.verified());
  EXPECT_EQ(report.difference->tick, 207u);
  EXPECT_EQ(report.difference->what, "7 ticks before it were lost");
  EXPECT_EQ(momentOf(session.path, 0.150).divergence, std::nullopt);
  const ReplayedState after = momentOf(session.path, 0.3);
  ASSERT_TRUE(after.divergence.has_value());
  EXPECT_EQ(after.divergence->tick, 207u);
}

TEST(Replay, DoesNotVerifyASessionWhoseLastTicksWereLost) {
  Recorded session;
  session.write(true, 3);
  const ReplayReport report = verify(session.path);
  EXPECT_FALSE(report.verified());
  EXPECT_EQ(report.replayed, kTicks);
  EXPECT_EQ(report.line().find("NOT verified"), 0u) << report.line();
  EXPECT_NE(report.line().find("; 3 ticks were lost"), std::string::npos) << report.line();
}

TEST(Replay, VerifiesAKilledSessionAndSaysSo) {
  Recorded session;
  session.write(false);
  const ReplayReport report = verify(session.path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_FALSE(report.closed);
  EXPECT_NE(report.line().find("ended early (killed, or disk full)"), std::string::npos);
}

TEST(Replay, ReportsAChangedFileInsteadOfRunningIt) {
  Recorded session;
  session.write();
  std::string bytes = test::bytesOf(session.path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  test::writeBytes(session.path, bytes);
  const ReplayReport report = verify(session.path);
  EXPECT_FALSE(report.verified());
  EXPECT_TRUE(report.damage.has_value());
  EXPECT_THROW(momentOf(session.path, 1.0), SessionError);
  EXPECT_THROW(metricsOf(session.path), SessionError);
}

TEST(Replay, AnswersNoWhicheverByteWasChanged) {
  Recorded session;
  session.ticks.resize(60);
  session.write();
  const std::string whole = test::bytesOf(session.path);
  std::mt19937 random(5);
  for (std::size_t at = 0; at < whole.size(); at += at < 120 ? 1 : 1 + random() % 400) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (random() % 8)));
    test::writeBytes(session.path, changed);
    EXPECT_FALSE(verify(session.path).verified()) << "byte " << at;
  }
  test::writeBytes(session.path, whole.substr(0, whole.size() / 2));
  EXPECT_FALSE(verify(session.path).verified());
}

TEST(Replay, RefusesWhatNeverWasASession) {
  const tests::ScratchFolder folder;
  test::writeBytes(folder.file("text"), std::string(5000, 'x'));
  EXPECT_THROW(verify(folder.file("text")), SessionError);
  EXPECT_THROW(verify(folder.file("missing")), SessionError);
}

TEST(Replay, BringsBackTheBoneOfAnyMoment) {
  Recorded session;
  session.write();
  EXPECT_TRUE(std::ranges::equal(momentOf(session.path, 0.0).bodies.solidInGridOrder(), session.block.solid));
  for (const std::size_t ticks : {1u, 50u, 437u, 500u, 501u}) {
    haptics::Bodies bone(session.block.grid, session.block.solid, session.block.label);
    test::rehearse(bone, session.block.start().command, ticks, kChange);
    const ReplayedState moment = momentOf(session.path, (static_cast<double>(ticks) - 0.5) * 0.001);
    EXPECT_TRUE(std::ranges::equal(moment.bodies.solidInGridOrder(), bone.solidInGridOrder())) << ticks;
    EXPECT_EQ(moment.tick.index, ticks - 1);
    EXPECT_EQ(moment.command.serial, ticks <= kChange ? 1u : 2u);
  }
  const ReplayedState end = momentOf(session.path, std::numeric_limits<double>::infinity());
  EXPECT_EQ(end.bodies.digest(), session.bone.digest());
}

TEST(Replay, ReadsTheNumbersOfAnotherVersionAndComparesNothing) {
  Recorded session;
  session.servo.revision = 99;
  session.ticks[321].commanded_force_P_N.xyz.z += 1.0;
  session.write();
  const ReplayReport report = verify(session.path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_EQ(report.replayed, 0u);
  EXPECT_EQ(report.ticks, kTicks);
  EXPECT_NE(report.line().find("recorded by another version (0.1.0 with servo revision 99, this is "),
            std::string::npos)
      << report.line();
  EXPECT_NE(report.line().find("values are read, a replay is not comparable"), std::string::npos);
  EXPECT_NEAR(metricsOf(session.path).removed_mm3_by_label->at("cortical"), session.bone.removedByTissue_mm3()[1],
              1e-12);
  // Its checksums are asked for all the same.
  std::string bytes = test::bytesOf(session.path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  test::writeBytes(session.path, bytes);
  EXPECT_FALSE(verify(session.path).verified());
}

TEST(Replay, ComparesNothingThatAnotherKindOfProcessorSummed) {
  Recorded session;
  session.servo.instruction_set = thisServo().instruction_set == "portable" ? "avx2" : "portable";
  session.ticks[321].commanded_force_P_N.xyz.z += 1e-7;
  session.write();
  const ReplayReport report = verify(session.path);
  EXPECT_TRUE(report.verified()) << report.line();
  EXPECT_NE(report.line().find("another instruction set"), std::string::npos) << report.line();
}

TEST(Replay, ComparesWhatWasSummedWithVectorsOfAnyWidth) {
  const ServoBuild avx2{1, "avx2"}, avx512{1, "avx512"}, portable{1, "portable"};
  EXPECT_TRUE(avx2.sumsIdentically(avx512));
  EXPECT_TRUE(portable.sumsIdentically(portable));
  EXPECT_FALSE(avx512.sumsIdentically(portable));
}

TEST(Replay, TakesASessionThatDoesNotTellItsServoForAnOlderOne) {
  std::string about = aboutText(test::BoneBlock().start());
  about.replace(about.find("servo_revision"), 14, "of_another_key");
  EXPECT_EQ(aboutFromText(about).start.servo.revision, 0);
}

TEST(Metrics, StandAsRecordedThoughARerunDiffersAndTicksWereLost) {
  Recorded session;
  session.ticks[100].law_force_P_N.xyz.x += 1e-12;
  session.ticks.erase(session.ticks.begin() + 200, session.ticks.begin() + 207);
  session.write(true, 7);
  ASSERT_FALSE(verify(session.path).verified());
  const SessionMetrics metrics = metricsOf(session.path);
  EXPECT_EQ(metrics.lost, 7u);
  EXPECT_NEAR(metrics.removed_mm3_by_label->at("cortical"), session.bone.removedByTissue_mm3()[1], 1e-12);
}

TEST(Metrics, CountTheVolumeOfLostTicksToo) {
  for (const bool closed : {true, false}) {
    Recorded session;
    const auto lost = session.ticks.begin() + 200;  // while it drills
    double lost_mm3 = 0.0;
    for (auto tick = lost; tick != lost + 60; ++tick) lost_mm3 += tick->removed_mm3;
    ASSERT_GT(lost_mm3, 0.001);
    session.ticks.erase(lost, lost + 60);
    session.write(closed, closed ? 60 : 0);
    const SessionMetrics metrics = metricsOf(session.path);
    EXPECT_EQ(metrics.lost, 60u) << "by the seal, or by the gap in the numbers of the ticks";
    EXPECT_NEAR(metrics.removed_mm3, session.bone.removedByTissue_mm3()[1], 1e-12);
    EXPECT_EQ(verify(session.path).lost, 60u);
  }
}

TEST(Metrics, OfAKilledRecordingComeFromItsTicks) {
  Recorded session;
  session.write(false);
  const SessionMetrics metrics = metricsOf(session.path);
  EXPECT_FALSE(metrics.closed);
  EXPECT_NEAR(metrics.removed_mm3_by_label->at("cortical"), session.bone.removedByTissue_mm3()[1], 1e-12);
}

TEST(BoneAtTime, IsTheOneThatWasLeftWhateverARerunWouldSay) {
  Recorded session;
  session.servo.revision = 99;
  for (haptics::Tick& tick : session.ticks) tick.hand.X_PT.translation_mm.z += 5.0;
  session.write();
  const BoneAtTime bone = boneAtTime(session.path, std::nullopt);
  EXPECT_EQ(bone.solid, session.bone.solidInGridOrder());
  EXPECT_NEAR(bone.t_s, 0.9, 1e-9);
  EXPECT_TRUE(bone.remarks.empty());
  EXPECT_EQ(boneAtTime(session.path, 77.0).solid, bone.solid) << "past the end";
}

TEST(BoneAtTime, OfAKilledRecordingIsRunAgainAndSaysSo) {
  Recorded session;
  session.write(false);
  const BoneAtTime bone = boneAtTime(session.path, std::nullopt);
  EXPECT_EQ(bone.solid, session.bone.solidInGridOrder());
  ASSERT_EQ(bone.remarks.size(), 1u);
  EXPECT_NE(bone.remarks[0].find("recomputed by a replay"), std::string::npos) << bone.remarks[0];
}

TEST(BoneAtTime, OfARerunThatDepartsSaysByHowMuch) {
  Recorded session;
  // The bur is lifted out of the bone where the recording has it in.
  for (std::size_t n = 300; n < kTicks; ++n) session.ticks[n].hand.X_PT.translation_mm.z += 5.0;
  session.write(false);
  const BoneAtTime bone = boneAtTime(session.path, std::nullopt);
  ASSERT_EQ(bone.remarks.size(), 2u);
  EXPECT_NE(bone.remarks[1].find("differs from the recording from tick 300"), std::string::npos) << bone.remarks[1];
  EXPECT_NE(bone.remarks[1].find("less of the bone is removed than recorded"), std::string::npos) << bone.remarks[1];
}

TEST(BoneAtTime, IsTheRecordedOneWhereForcesAloneDiffer) {
  Recorded session;
  session.ticks[300].commanded_force_P_N.xyz.z = std::nextafter(session.ticks[300].commanded_force_P_N.xyz.z, 9.0);
  session.write();
  EXPECT_FALSE(verify(session.path).verified());
  EXPECT_TRUE(boneAtTime(session.path, 0.5).remarks.empty()) << "its digest says that it is the same bone";
}

TEST(Replay, ComparesTheBoneThatWasLeftAndWhatWasRemovedByTissue) {
  Recorded session;
  const haptics::Bodies untouched(session.block.grid, session.block.solid, session.block.label);
  {
    SessionWriter writer(session.path, true, session.block.start());
    writer.write({{}, {session.ticks.begin(), session.ticks.begin() + 400}, {}});
    writer.seal(0, &untouched);
  }
  EXPECT_EQ(verify(session.path).difference->what, "the final bone differs");
  session.ticks[449].removed_total_mm3[2] += 0.5;  // the last of a block
  session.write();
  EXPECT_EQ(verify(session.path).difference->what, "the removed volume by tissue differs");
}

TEST(Metrics, AddUpWhatTheTicksSay) {
  Recorded session;
  for (haptics::Tick& tick : session.ticks) tick.work_us = static_cast<float>(tick.index);
  session.write();
  const SessionMetrics metrics = metricsOf(session.path);
  EXPECT_EQ(metrics.patient_title, "block of bone");
  EXPECT_EQ(metrics.ticks, kTicks);
  EXPECT_EQ(metrics.commands, 2u);
  EXPECT_EQ(metrics.events, 1u);
  EXPECT_NEAR(metrics.duration_s, 0.9, 1e-9);
  EXPECT_NEAR(metrics.drill_on_s, 0.5, 0.002);

  double path_mm = 0.0, removed_mm3 = 0.0, max_force_N = 0.0;
  for (std::size_t n = 0; n < kTicks; ++n) {
    const haptics::Tick& tick = session.ticks[n];
    if (n > 0) path_mm += glm::distance(tick.hand.X_PT.translation_mm, session.ticks[n - 1].hand.X_PT.translation_mm);
    removed_mm3 += tick.removed_mm3;
    max_force_N = std::max(max_force_N, glm::length(tick.commanded_force_P_N.xyz));
  }
  EXPECT_NEAR(metrics.path_mm, path_mm, 1e-9);
  EXPECT_NEAR(metrics.removed_mm3, removed_mm3, 1e-9);
  EXPECT_EQ(metrics.max_force_N, max_force_N);
  EXPECT_GT(metrics.removed_mm3, 0.1);

  double by_label = 0.0;
  for (const auto& [tissue, volume] : *metrics.removed_mm3_by_label) by_label += volume;
  EXPECT_NEAR(by_label, metrics.removed_mm3, 1e-6);
  EXPECT_FALSE(metrics.removed_mm3_by_label->contains("enamel")) << "the bur never reached the enamel";
  EXPECT_EQ(metrics.work_p50_us, 449.0);
  EXPECT_EQ(metrics.work_max_us, 899.0);
}

TEST(Metrics, AreOneJsonObject) {
  Recorded session;
  session.write();
  const std::string json = metricsJson(metricsOf(session.path));
  EXPECT_EQ(json.front(), '{');
  EXPECT_NE(json.find("\"duration_s\": 0.9"), std::string::npos) << json;
  EXPECT_NE(json.find("\"ticks\": 900"), std::string::npos);
  EXPECT_NE(json.find("\"rig\": \"none\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"removed_mm3_by_label\": {"), std::string::npos);
}

}  // namespace
}  // namespace app
