#include "app/controls/active_command.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>

#include "app/session/metrics.h"
#include "app/session/replay.h"
#include "app/session/session_reader.h"
#include "haptics/device/simulated/mouse_device.h"
#include "tests/app/session/real_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

/// A recorded rehearsal with the mouse device, without a view, stepped.
struct Desk {
  tests::ScratchFolder folder;
  std::string path = folder.file("s.molar");
  test::BoneBlock block;
  assets::Patient patient;
  haptics::MouseDevice* mouse = nullptr;
  std::optional<Workstation> workstation;
  std::optional<ActiveCommand> active;

  explicit Desk(const std::string& settings_file = {}, const std::vector<haptics::Tool>& other_tools = {}) {
    patient.title = "block of bone";
    patient.ct.grid = block.grid;
    patient.ct.solid = block.solid;
    patient.ct.label = block.label;
    auto device = std::make_unique<haptics::MouseDevice>(at({0.0, 0.0, 2.0}, false));
    mouse = device.get();
    active.emplace(block.start().command, other_tools, settings_file, 0.002, 1000.0);
    haptics::LoopSettings settings;
    settings.priority = std::nullopt;
    workstation.emplace(patient, std::move(device), settings, active->inForce(), Recording{path, true},
                        Ticking::stepped);
    active->attach(*workstation);
    workstation->start();
  }

  static haptics::MouseTarget at(const glm::dvec3& place_mm, bool pedal) {
    haptics::MouseTarget target;
    target.X_DH.translation_mm = place_mm;
    target.pedal = pedal;
    return target;
  }

  /// Ticks until it is seen, a minute of the hand's time at most.
  bool waitFor(const std::function<bool(const haptics::Tick&)>& seen) {
    for (int n = 0; n < 60'000; ++n) {
      workstation->step(1);
      if (seen(workstation->newestTick())) return true;
    }
    return false;
  }
};

bool hasEvent(const std::string& path, const std::string& kind, const std::string& words) {
  for (const SessionEvent& event : SessionReader(path).events())
    if (event.kind == kind && event.text.find(words) != std::string::npos) return true;
  return false;
}

TEST(ActiveCommand, UndoesAStrokeAndRecordsItForReplay) {
  Desk at;
  std::uint64_t whole = 0, cut = 0;
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) { return (whole = tick.bone_digest) != 0; }));
  at.active->execute({Control::undo});
  EXPECT_EQ(at.active->inForce().undo_serial, 0u) << "there is none yet";
  at.mouse->setTarget(Desk::at({0.0, 0.0, 0.4}, true));
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) { return tick.strokes == 1; }));
  at.workstation->step(300);
  at.mouse->setTarget(Desk::at({0.0, 0.0, 2.5}, false));
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) {
    cut = tick.bone_digest;
    return !tick.drilling && tick.overlap_mm3 == 0.0;
  }));
  EXPECT_NE(cut, whole);
  at.active->execute({Control::undo});
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) { return tick.strokes == 0; }));
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) { return tick.bone_digest == whole; }));
  at.active->followStrokes(at.workstation->newestTick());
  at.active->execute({Control::redo});
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) { return tick.bone_digest == cut; }));
  at.active->followStrokes(at.workstation->newestTick());
  at.active->execute({Control::redo});
  EXPECT_EQ(at.active->inForce().redo_serial, 1u) << "there is none left";
  at.active->execute({Control::undo});
  ASSERT_TRUE(at.waitFor([&](const haptics::Tick& tick) { return tick.bone_digest == whole; }));
  at.workstation->stop();
  EXPECT_TRUE(verify(at.path).verified()) << verify(at.path).line();
  EXPECT_TRUE(hasEvent(at.path, "undo", " mm³ taken back, 0 strokes left"));
  EXPECT_TRUE(hasEvent(at.path, "redo", " mm³ cut again, 0 strokes left to redo"));
  EXPECT_GT(metricsOf(at.path).returned_mm3, 0.0);
}

TEST(ActiveCommand, SwitchesIrrigation) {
  Desk at;
  EXPECT_TRUE(at.active->inForce().irrigating);
  at.active->execute({Control::irrigation});
  EXPECT_FALSE(at.active->inForce().irrigating);
  at.mouse->setTarget(Desk::at({0.0, 0.0, 0.4}, true));
  ASSERT_TRUE(at.waitFor([](const haptics::Tick& tick) { return tick.strokes == 1 && tick.t_s > 0.1; }));
  // A guide decides about the drill, not about water, undo and faults.
  haptics::Command guided = at.active->inForce();
  guided.irrigating = true;
  guided.undo_serial = 7;
  guided.rearm = 7;
  at.active->adopt(guided);
  EXPECT_FALSE(at.active->inForce().irrigating);
  EXPECT_EQ(at.active->inForce().undo_serial, 0u);
  EXPECT_EQ(at.active->inForce().rearm, 0u) << "only the instructor lifts a fault";
  at.active->execute({Control::irrigation});
  EXPECT_TRUE(at.active->inForce().irrigating);
  ASSERT_TRUE(at.waitFor([](const haptics::Tick& tick) { return tick.command_serial == 4; }));
  at.workstation->stop();
  EXPECT_GT(metricsOf(at.path).dry_drilling_s, 0.0);
  EXPECT_TRUE(hasEvent(at.path, "irrigation", "off"));
  EXPECT_TRUE(hasEvent(at.path, "irrigation", "on"));
}

TEST(ActiveCommand, NeitherFileNorProcedureLiftsAFault) {
  tests::ScratchFolder folder;
  const std::string settings = folder.file("feel.toml");
  const auto write = [&](const char* text) { std::ofstream(settings) << text; };
  write("[law]\nname = \"agus\"\n");
  Desk at(settings);
  const haptics::Command before = at.active->inForce();
  at.active->execute({Control::arm});
  const std::uint64_t armed = at.active->inForce().rearm;
  ASSERT_NE(armed, before.rearm);
  at.active->adopt(before);
  EXPECT_EQ(at.active->inForce().rearm, armed) << "a procedure's command keeps the rearm count";
  write("# longer, so that it is read again\n[law]\nname = \"forssim\"\n");
  const LiveParameters::Clock::time_point start;
  at.active->pollSettingsFile(start + std::chrono::seconds(1));
  ASSERT_EQ(at.active->inForce().law.kind, haptics::LawKind::forssim);
  EXPECT_EQ(at.active->inForce().rearm, armed);
  at.workstation->stop();
}

TEST(ActiveCommand, ChangesToTheGivenToolOrTheNext) {
  std::vector<haptics::Tool> others(2);
  others[0].head.radius_mm = 0.5;
  others[1].head.radius_mm = 0.8;
  Desk at({}, others);
  const auto radiusAfter = [&](const ControlRequest& request) {
    EXPECT_TRUE(at.active->execute(request));
    return at.active->inForce().tool.head.radius_mm;
  };
  EXPECT_EQ(radiusAfter({Control::tool, 2}), 0.8);
  EXPECT_TRUE(at.active->takeToolChange());
  EXPECT_EQ(radiusAfter({Control::tool}), 1.0) << "after the last one the first";
  EXPECT_EQ(radiusAfter({Control::tool}), 0.5);
  EXPECT_EQ(radiusAfter({Control::tool, 3}), 0.5) << "there is no fourth";
  EXPECT_EQ(radiusAfter({Control::tool}), 0.8) << "the one after the current tool";
}

TEST(ActiveCommand, NamesTheRowOfARefusedRequest) {
  std::vector<haptics::Tool> others(1);
  others[0].head = {haptics::ShapeKind::cone, 1.0, 2.0};
  Desk at({}, others);
  at.active->execute({Control::tool, 1});
  const auto saidOf = [&](const ControlRequest& request) {
    testing::internal::CaptureStderr();
    EXPECT_TRUE(at.active->execute(request, "pose file a.csv line 7"));
    return testing::internal::GetCapturedStderr();
  };
  const ControlRequest harmonic = requestFrom("law:harmonic");
  for (const ControlRequest& request : {harmonic, ControlRequest{Control::tool, 5}, ControlRequest{Control::undo}})
    EXPECT_EQ(saidOf(request).find("molar: pose file a.csv line 7: "), 0u) << saidOf(request);
}

TEST(ActiveCommand, DrawsAToolSetByAProcedure) {
  Desk at;
  haptics::Command guided = at.active->inForce();
  at.active->adopt(guided);
  EXPECT_FALSE(at.active->takeToolChange());
  guided.tool.head.radius_mm = 0.7;
  at.active->adopt(guided);
  EXPECT_TRUE(at.active->takeToolChange());
  guided.tool.shaft.radius_mm = 0.4;
  at.active->adopt(guided);
  EXPECT_TRUE(at.active->takeToolChange()) << "the neck is drawn too";
}

TEST(ActiveCommand, SetsASwitchOrTogglesIt) {
  Desk at;
  ASSERT_TRUE(at.waitFor([](const haptics::Tick& tick) { return tick.dt_s > 0.0; }));
  for (const bool on : {false, false, true, true}) {
    at.active->execute({Control::drill, on ? 1 : 0});
    at.active->execute({Control::irrigation, on ? 1 : 0});
    EXPECT_EQ(at.active->inForce().drill_enabled, on);
    EXPECT_EQ(at.active->inForce().irrigating, on);
  }
  at.active->execute({Control::drill});
  EXPECT_FALSE(at.active->inForce().drill_enabled);
  at.active->execute({Control::law, 1});
  EXPECT_EQ(at.active->inForce().law.kind, haptics::LawKind::forssim);
  at.workstation->stop();
  EXPECT_TRUE(hasEvent(at.path, "drill", "drill locked"));
  EXPECT_TRUE(hasEvent(at.path, "drill", "drill unlocked"));
  for (const Control others : {Control::snapshot, Control::stop, Control::home, Control::end, Control::layer})
    EXPECT_FALSE(at.active->execute({others, 0})) << meaningOf(others).name;
}

TEST(ActiveCommand, DoesNotLiftAnEmergencyStop) {
  Desk at;
  ASSERT_TRUE(at.waitFor([](const haptics::Tick& tick) { return tick.dt_s > 0.0; }));
  at.workstation->emergencyStop();
  ASSERT_TRUE(at.waitFor([](const haptics::Tick& tick) { return tick.state == haptics::SafetyState::off; }));
  at.active->execute({Control::arm});
  EXPECT_EQ(at.active->inForce().rearm, 0u);
  at.workstation->stop();
}

}  // namespace
}  // namespace app
