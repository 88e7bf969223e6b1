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
