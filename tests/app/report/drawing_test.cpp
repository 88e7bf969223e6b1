#include "app/report/drawing.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/calibrate/report/markup.h"

namespace app {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Drawing, IsWellFormedAndSaysWhatItShows) {
  Drawing drawing({100.0, 50.0});
  drawing.line({0, 0}, {1, 1}, 1.0, paper::kInk, {4.0, 3.0});
  drawing.path({{0, 0}, {1, 2}, {3, 4}}, 1.0, paper::kInk);
  drawing.polygon({{0, 0}, {1, 2}, {3, 4}}, paper::kBlue);
  drawing.box({0, 0}, {-1, 5}, paper::kGreen);
  drawing.outline({0, 0}, {5, 5}, 1.0, paper::kGreen);
  drawing.disc({5, 5}, 2, paper::kWhite);
  drawing.cross({5, 5}, 2, 1.0, paper::kInk);
  drawing.arrow({5, 5}, {50, 5}, 1.0, paper::kInk);
  drawing.arrow({5, 5}, {5, 5}, 1.0, paper::kInk);
  drawing.text("a < b & c", {5, 5}, 12.0, paper::kInk, Align::right, true);
  const std::string markup = drawing.markup("a \"drawing\" of <things>");
  EXPECT_EQ(whatIsWrongWith(markup), "");
  EXPECT_THAT(markup, HasSubstr("viewBox=\"0 0 100.00 50.00\""));
  EXPECT_THAT(markup, HasSubstr("aria-label=\"a &quot;drawing&quot; of &lt;things&gt;\""));
}

TEST(Drawing, KeepsWordsAsWordsAndHasNoIdsThatClash) {
  Drawing drawing({200.0, 50.0});
  drawing.text("a < b & c", {50, 20}, 11.7, paper::kBlue, Align::right, true);
  EXPECT_GT(drawing.paragraph("two words", {100, 20}, 30.0, 11.7, paper::kInk), 20.0);
  const std::string markup = drawing.markup("");
  EXPECT_THAT(markup, testing::ContainsRegex("<text x=\"50.00\" y=\"2[0-9.]+\" font-size=\"10.00\" "
                                             "font-weight=\"bold\" fill=\"#0072b2\" text-anchor=\"end\">"
                                             "a &lt; b &amp; c</text>"));
  EXPECT_THAT(markup, HasSubstr(">two </text>"));
  EXPECT_THAT(markup, HasSubstr(">words</text>"));
  EXPECT_THAT(markup, Not(HasSubstr("id=")));
}

TEST(Drawing, WritesNoNumberThatIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Drawing drawing({10.0, 10.0});
  drawing.disc({nan, std::numeric_limits<double>::infinity()}, 1.0, paper::kInk);
  drawing.path({{0, 0}, {1, 1}, {nan, nan}, {2, 2}, {3, 3}}, 1.0, paper::kInk);
  const std::string markup = drawing.markup("");
  EXPECT_THAT(markup, Not(testing::AnyOf(HasSubstr("nan"), HasSubstr("inf"))));
  EXPECT_THAT(markup, HasSubstr("d=\"M 0 0 L 1 1 M 2 2 L 3 3 \""));
}

TEST(Drawing, PointsAnArrowAtItsEnd) {
  Drawing drawing({100.0, 100.0});
  drawing.arrow({10.0, 20.0}, {60.0, 20.0}, 1.0, paper::kInk);
  EXPECT_THAT(drawing.markup(""), HasSubstr("d=\"M 60 20 L 55 22.25 L 55 17.75 \""));
}

}  // namespace
}  // namespace app
