#include "app/report/markup.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(Markup, EscapesWhatWouldBeRead) {
  EXPECT_EQ(escaped("<b a=\"1\" c='2'>&\n</b>"), "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;&lt;/b&gt;");
  EXPECT_EQ(escaped("\u00e5 3 \u03c3"), "\u00e5 3 \u03c3");
}

TEST(Markup, WritesNumbersAsInPrint) {
  EXPECT_EQ(fixedText(1.005, 1), "1.0");
  EXPECT_EQ(fixedText(-0.25, 2), "\u22120.25");
  EXPECT_EQ(fixedText(-0.001, 2), "0.00");
  EXPECT_EQ(timeText("2026-11-21T08:20:00Z"), "2026-11-21 08:20 UTC");
  EXPECT_EQ(timeText("once"), "once");
}

}  // namespace
}  // namespace app
