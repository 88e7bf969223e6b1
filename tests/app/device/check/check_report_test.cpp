#include "app/device/check/check_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace app {
namespace {

using testing::HasSubstr;
using testing::Not;

CheckReport goodReport() {
  CheckReport report;
  report.address = "openhaptics";
  report.date = "2026-11-21 10:00";
  report.program = "0.1.0";
  report.device.model = "Touch";
  report.device.serial = "0123456789AB4F21";
  report.device.provenance = haptics::Provenance::vendor_library;
  report.lines = {{"pushes up", "up", "up, moved +1.6 mm", Verdict::ok},
                  {"deadman", "none", "none", Verdict::not_there}};
  report.confirmed = {Evidence::moves, Evidence::force_sign};
  return report;
}

TEST(CheckReport, TicksOffWhatARealUnitProved) {
  const std::string page = pageOf(goodReport());
  EXPECT_THAT(page, HasSubstr("# Check of Touch"));
  EXPECT_THAT(page, HasSubstr("| pushes up | up | up, moved +1.6 mm | ok |"));
  EXPECT_THAT(page, HasSubstr("- [x] the force has the right sign on every axis"));
  EXPECT_THAT(page, HasSubstr("- [ ] a newton is a newton"));
  EXPECT_THAT(page, HasSubstr("- [ ] how warm the motors become"));
}

TEST(CheckReport, TicksNothingOffForASimulatedUnit) {
  CheckReport report = goodReport();
  report.device.provenance = haptics::Provenance::simulated;
  EXPECT_THAT(pageOf(report), Not(HasSubstr("[x]")));
  EXPECT_THAT(pageOf(report), HasSubstr("simulated"));
}

TEST(CheckReport, ShowsOnlyTheEndOfASerialNumber) {
  EXPECT_THAT(pageOf(goodReport()), Not(HasSubstr("0123456789AB")));
  EXPECT_THAT(pageOf(goodReport()), HasSubstr("…4F21"));
  EXPECT_EQ(shortened(""), "");
  EXPECT_EQ(shortened("1234"), "1234");
}

TEST(CheckReport, IsGoodOnlyToTheEndAndWithNothingWrong) {
  CheckReport report = goodReport();
  EXPECT_TRUE(report.isGood());
  report.left_early = true;
  EXPECT_FALSE(report.isGood());
  report.left_early = false;
  report.lines.push_back({"rate", "1000 Hz", "700 Hz", Verdict::wrong});
  EXPECT_FALSE(report.isGood());
  EXPECT_THAT(pageOf(report), HasSubstr("| rate | 1000 Hz | 700 Hz | **WRONG** |"));
}

TEST(CheckReport, EscapesNamesThatWouldBreakTheTable) {
  CheckReport report = goodReport();
  report.device.model = "a|b\n# c";
  report.lines[0].found = "x|y\nz";
  EXPECT_THAT(pageOf(report), HasSubstr("# Check of a b # c\n"));
  EXPECT_THAT(pageOf(report), HasSubstr("| x y z | ok |"));
}

}  // namespace
}  // namespace app
