#include "app/session/locator_event.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(LocatorEvent, ReadsBackWhatWasWritten) {
  for (const LocatorTold& told : {LocatorTold{1.4, false, "distal"}, LocatorTold{0.0, true, "perforation"}})
    EXPECT_EQ(locatorFrom(locatorText(told)), told);
  EXPECT_EQ(locatorText(LocatorTold{0.5, false, "second mesiobuccal"}), "0.5 second mesiobuccal");
  EXPECT_FALSE(locatorFrom(locatorText({}))) << "off";
  for (const char* const text : {"", "real, seed 4711", "exact", "-1 distal", "nan distal", "1e9 distal"})
    EXPECT_FALSE(locatorFrom(text)) << text;
}

}  // namespace
}  // namespace app
