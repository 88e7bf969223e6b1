#include "app/instructor/rehearsal_status.h"

#include <gtest/gtest.h>

namespace app {
namespace {

RehearsalStatus atWork() {
  RehearsalStatus status;
  status.tick.state = haptics::SafetyState::active;
  status.tick.t_s = 12.34;
  return status;
}

TEST(RehearsalStatus, LineShowsTheState) {
  const std::string line = statusLine(atWork());
  EXPECT_EQ(line.find("Molar   12.3 s   agus   force 0.00 N"), 0u) << line;
  EXPECT_NE(line.find("drill off"), std::string::npos);
}

TEST(RehearsalStatus, LineShowsTheProceduresMessage) {
  RehearsalStatus status = atWork();
  status.to_surgeon = "trial 2 of at most 40";
  status.to_instructor = "trial 2, felt: A";
  EXPECT_EQ(statusLine(status), "Molar   trial 2 of at most 40");
  status.recording = RecordingState::ended_early;
  EXPECT_EQ(statusLine(status), "Molar   NOT RECORDING   trial 2 of at most 40");
  status.tick.state = haptics::SafetyState::fault;
  EXPECT_EQ(statusLine(status).find("trial"), std::string::npos) << "safety first";
}

TEST(RehearsalStatus, LineWarnsWhenRecordingEnded) {
  RehearsalStatus status = atWork();
  EXPECT_EQ(statusLine(status).find("NOT RECORDING"), std::string::npos);
  status.recording = RecordingState::ended_early;
  EXPECT_NE(statusLine(status).find("NOT RECORDING"), std::string::npos);
}

TEST(RehearsalStatus, ShowsTheDrillState) {
  RehearsalStatus status = atWork();
  EXPECT_STREQ(drillText(status), "drill off");
  status.command.drill_enabled = false;
  EXPECT_STREQ(drillText(status), "drill locked");
  status.tick.drilling = true;
  EXPECT_STREQ(drillText(status), "drilling");
  status.command.irrigating = false;
  EXPECT_STREQ(drillText(status), "drilling dry");
}

}  // namespace
}  // namespace app
