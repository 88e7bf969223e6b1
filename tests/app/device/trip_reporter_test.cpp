#include "app/device/trip_reporter.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using haptics::Fault;
using haptics::SafetyState;
using haptics::TripCounter;

TEST(TripReporter, ReportsATripOnceEachTimeItHappens) {
  TripReporter reporter;
  TripCounter trips;
  EXPECT_TRUE(reporter.update(trips, SafetyState::active).empty());
  trips.add(7, Fault::buzz);
  const auto first = reporter.update(trips, SafetyState::active);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_NE(first[0].find("oscillated"), std::string::npos);
  EXPECT_NE(first[0].find("(tick 7)"), std::string::npos);
  trips.add(8, Fault::buzz);
  EXPECT_TRUE(reporter.update(trips, SafetyState::active).empty()) << "it goes on";
  trips.add(9, Fault::none);
  trips.add(10, Fault::buzz);
  const auto second = reporter.update(trips, SafetyState::active);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_NE(second[0].find("2 times"), std::string::npos);
}

TEST(TripReporter, CountsLimitsWithoutReportingThem) {
  TripReporter reporter;
  TripCounter trips;
  trips.add(1, Fault::clamped | Fault::slewed);
  EXPECT_TRUE(reporter.update(trips, SafetyState::active).empty());
  EXPECT_EQ(tripsText(trips), "clamped 1, slewed 1");
  EXPECT_EQ(tripsText({}), "none");
}

TEST(TripReporter, SaysOnceThatTheLoopPausesAndThenCounts) {
  TripReporter reporter;
  TripCounter trips;
  std::size_t lines = 0;
  for (std::uint64_t n = 0; n < 20; ++n) {
    trips.add(1000 * n, Fault::resumed);
    lines += reporter.update(trips, SafetyState::ready).size();
    trips.add(1000 * n + 1, Fault::none);
    lines += reporter.update(trips, SafetyState::active).size();
  }
  EXPECT_EQ(lines, 3u) << "the pause, no force, force again";
  EXPECT_EQ(tripsText(trips), "resumed 20");
  EXPECT_EQ(reporter.update(trips, SafetyState::ready).size(), 1u) << "for another reason it is said again";
}

TEST(TripReporter, ReportsWhatAnotherStateMeans) {
  TripReporter reporter;
  EXPECT_EQ(reporter.update({}, SafetyState::ready).size(), 1u);
  EXPECT_TRUE(reporter.update({}, SafetyState::ready).empty());
  EXPECT_EQ(reporter.update({}, SafetyState::active).size(), 1u);
}

}  // namespace
}  // namespace app
