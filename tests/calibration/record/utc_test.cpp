#include "calibration/record/utc.h"

#include <gtest/gtest.h>

namespace calibration {
namespace {

TEST(Utc, ConvertsToSecondsAndBack) {
  EXPECT_EQ(secondsOfUtc("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(secondsOfUtc("2000-03-01T00:00:00Z"), 951868800);
  EXPECT_EQ(secondsOfUtc("2026-11-21T08:20:00Z"), 1795249200);
  for (std::int64_t t = -86400LL * 400; t < 86400LL * 40000; t += 8639999) EXPECT_EQ(secondsOfUtc(utcOf(t)), t);
}

TEST(Utc, KnowsLeapYears) {
  EXPECT_TRUE(secondsOfUtc("2028-02-29T00:00:00Z"));
  EXPECT_FALSE(secondsOfUtc("2026-02-29T00:00:00Z"));
  EXPECT_FALSE(secondsOfUtc("2100-02-29T00:00:00Z"));
}

TEST(Utc, RefusesInvalidTimes) {
  for (const char* text : {"", "2026-11-21", "2026-11-21 08:20:00Z", "2026-11-21T08:20:00", "2026-11-21T08:20:00+01:00",
                           "2026-13-01T00:00:00Z", "2026-11-21T24:00:00Z", "2026-11-21T08:60:00Z",
                           "-026-11-21T08:20:00Z", "2026-11-21T08:20:00Zx"})
    EXPECT_FALSE(secondsOfUtc(text)) << text;
}

}  // namespace
}  // namespace calibration
