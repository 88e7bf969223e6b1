#include "app/report/svg.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/calibrate/report/markup.h"

namespace app {
namespace {

using testing::HasSubstr;

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

TEST(Svg, IsWellFormed) {
  Svg svg({100.0, 50.0}, "a \"drawing\" of <things>");
  svg.line({0, 0}, {1, 1}, {paper::kInk, 1.0, "4 3"});
  svg.path({{0, 0}, {1, 2}, {3, 4}}, {});
  svg.area({{0, 0}, {1, 2}, {3, 4}}, paper::kBlue);
  svg.box({0, 0}, {-1, 5}, paper::kGreen);
  svg.disc({5, 5}, 2, paper::kWhite, {});
  svg.cross({5, 5}, 2, {});
  svg.arrow({5, 5}, {50, 5}, {});
  svg.arrow({5, 5}, {5, 5}, {});
  svg.words({5, 5}, "a < b & c", TextAnchor::end, paper::kInk, 9.0, true);
  EXPECT_EQ(whatIsWrongWith(svg.markup()), "");
  EXPECT_THAT(svg.markup(), HasSubstr("viewBox=\"0 0 100.00 50.00\""));
  EXPECT_THAT(svg.markup(), HasSubstr("a &lt; b &amp; c"));
}

TEST(Svg, WritesNoNumberThatIsNone) {
  Svg svg({10.0, 10.0}, "");
  svg.disc({std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}, 1.0, paper::kInk);
  EXPECT_THAT(svg.markup(), testing::Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("inf"))));
}

TEST(Svg, PointsAnArrowAtItsEnd) {
  Svg svg({100.0, 100.0}, "");
  svg.arrow({10.0, 20.0}, {60.0, 20.0}, {paper::kInk, 1.0});
  EXPECT_THAT(svg.markup(), HasSubstr("points=\"60.00,20.00 55.00,22.25 55.00,17.75\""));
}

}  // namespace
}  // namespace app
