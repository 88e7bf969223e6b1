#include "app/rehearsal/run_monitor.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using std::chrono::milliseconds;

RunMonitor::Time at(double s) {
  return RunMonitor::Time{} + std::chrono::duration_cast<RunMonitor::Time::duration>(std::chrono::duration<double>(s));
}

haptics::Tick tick(std::uint64_t index) {
  haptics::Tick t;
  t.index = index;
  t.dt_s = 0.001;
  t.t_s = 0.001 * static_cast<double>(index);
  t.state = haptics::SafetyState::active;
  return t;
}

TEST(RunMonitor, EndsWhenTheSimulatedTimeIsOver) {
  RunMonitor monitor(2.0);
  EXPECT_FALSE(monitor.ending(tick(1998), at(100.0), false, false));
  EXPECT_EQ(monitor.ending(tick(1999), at(100.0), false, false), Ending::time_over);
  RunMonitor endless(std::nullopt);
  EXPECT_FALSE(endless.ending(tick(86400'000), at(0.0), false, false));
}

TEST(RunMonitor, EndsOnRequest) {
  RunMonitor monitor(std::nullopt);
  EXPECT_FALSE(monitor.ending(tick(1), at(0.0), false, false));
  EXPECT_EQ(monitor.ending(tick(1), at(0.0), false, true), Ending::procedure);
  monitor.endByUser();
  EXPECT_EQ(monitor.ending(tick(1), at(0.0), false, true), Ending::by_user);
  EXPECT_EQ(monitor.ending(tick(1), at(0.0), true, true), Ending::interrupted) << "highest priority";
}

TEST(RunMonitor, EndsAfterTenSecondsWithoutATick) {
  RunMonitor monitor(std::nullopt);
  EXPECT_FALSE(monitor.ending(tick(0), at(50.0), false, false)) << "silence starts at the first call";
  EXPECT_FALSE(monitor.ending(tick(0), at(59.9), false, false));
  EXPECT_FALSE(monitor.ending(tick(7), at(59.95), false, false));
  EXPECT_FALSE(monitor.ending(tick(7), at(69.9), false, false));
  EXPECT_EQ(monitor.ending(tick(7), at(69.95), false, false), Ending::silent);
}

TEST(RunMonitor, ReportsAProblemOnceEachTimeItBegins) {
  RunMonitor monitor(std::nullopt);
  StationHealth health;
  EXPECT_TRUE(monitor.takeNotices(health, tick(1)).empty());
  health.device_trouble = "put the stylus into its inkwell";
  const std::vector<Notice> expected = {{"device", "put the stylus into its inkwell"}};
  EXPECT_EQ(monitor.takeNotices(health, tick(2)), expected);
  EXPECT_TRUE(monitor.takeNotices(health, tick(3)).empty());
  health.device_trouble.clear();
  EXPECT_TRUE(monitor.takeNotices(health, tick(4)).empty()) << "the end is not reported";
  health.device_trouble = "put the stylus into its inkwell";
  EXPECT_EQ(monitor.takeNotices(health, tick(5)), expected);
}

TEST(RunMonitor, ReportsOnceThatTheRecordingEndedAndShowsIt) {
  RunMonitor monitor(std::nullopt);
  RehearsalStatus status;
  status.recording = RecordingState::running;
  monitor.describe(status);
  EXPECT_EQ(status.recording, RecordingState::running);
  StationHealth health;
  health.recording_trouble = "the disk is full";
  EXPECT_EQ(monitor.takeNotices(health, tick(1)),
            (std::vector<Notice>{{"recording", "not recording, the rehearsal goes on: the disk is full"}}));
  EXPECT_TRUE(monitor.takeNotices(health, tick(2)).empty());
  monitor.describe(status);
  EXPECT_EQ(status.recording, RecordingState::ended_early);
  RehearsalStatus unrecorded;
  monitor.describe(unrecorded);
  EXPECT_EQ(unrecorded.recording, RecordingState::none);
}

TEST(RunMonitor, ReportsEveryTripOfTheSafetyLayerWithTheFirstTickNotBefore) {
  RunMonitor monitor(std::nullopt);
  StationHealth health;
  health.trips.add(10, haptics::Fault::buzz);
  EXPECT_TRUE(monitor.takeNotices(health, {}).empty()) << "no tick yet";
  const std::vector<Notice> expected = monitor.takeNotices(health, tick(11));
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_EQ(expected[0].kind, "safety");
  EXPECT_TRUE(monitor.takeNotices(health, tick(12)).empty());
  RehearsalStatus status;
  monitor.describe(status);
  EXPECT_EQ(status.trips.of(haptics::Fault::buzz).times, 1u);
}

TEST(RunMonitor, PassesNewsOn) {
  RunMonitor monitor(std::nullopt);
  StationHealth health;
  health.news = {"the unit was unplugged", "the mirror is lost"};
  EXPECT_EQ(monitor.takeNotices(health, tick(1)),
            (std::vector<Notice>{{"device", "the unit was unplugged"}, {"device", "the mirror is lost"}}));
}

}  // namespace
}  // namespace app
