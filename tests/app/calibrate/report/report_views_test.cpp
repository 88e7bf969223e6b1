#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/calibrate/report/report_views.h"
#include "app/report/markup.h"
#include "tests/app/calibrate/report/example_record.h"
#include "tests/app/calibrate/report/markup.h"

namespace app {
namespace {

using calibration::DriftQuantity;
using calibration::Residual;
using testing::HasSubstr;
using testing::Not;

const std::string kBlue = "rgb\\(0%,44.7\\d*%,69.8\\d*%\\)", kInk = "rgb\\(13.3\\d*%,13.3\\d*%,13.3\\d*%\\)";

/// Ends of every line of a colour, y downwards.
std::vector<std::pair<glm::dvec2, glm::dvec2>> linesOf(const std::string& svg, const std::string& colour) {
  std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;
  const std::regex line(";stroke:" + colour + ";[^\"]*\" d=\"M (\\S+) (\\S+) L (\\S+) (\\S+) \"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), line), end; it != end; ++it)
    lines.push_back({{std::stod((*it)[1]), std::stod((*it)[2])}, {std::stod((*it)[3]), std::stod((*it)[4])}});
  return lines;
}

TEST(ResidualViews, DrawArrowsFiftyTimesAsLongAndSaySo) {
  // 0.5 mm to the right and up: in the front view as long as the scale's arrow times the root of two.
  const std::string svg = residualViews({}, {{1, {{-20, 0, 0}}, {{0.5, 0.5, 0.0}}, true}});
  EXPECT_THAT(svg, HasSubstr("0.5 mm (arrows 50 times as long)"));
  const auto arrows = linesOf(svg, kBlue), scale = linesOf(svg, kInk);
  ASSERT_EQ(arrows.size(), 2u);
  ASSERT_EQ(scale.size(), 1u);
  const double head = 0.7 * 5.4, unit = glm::distance(scale[0].first, scale[0].second) + head;
  EXPECT_NEAR(glm::distance(arrows[0].first, arrows[0].second) + head, std::sqrt(2.0) * unit, 0.05);
  EXPECT_GT(arrows[0].second.x, arrows[0].first.x);
  EXPECT_LT(arrows[0].second.y, arrows[0].first.y);
  EXPECT_EQ(whatIsWrongWith(svg), "");
}

TEST(ResidualViews, ShowTheViewerAtTheLeftFromTheRight) {
  const auto arrows = linesOf(residualViews({}, {{1, {{0, 0, 0}}, {{0.0, 0.0, 0.5}}, true}}), kBlue);
  ASSERT_EQ(arrows.size(), 2u);
  EXPECT_LT(arrows[1].second.x, arrows[1].first.x - 20.0);
}

TEST(ResidualViews, ShortenTheArrowsOfLargeErrors) {
  EXPECT_THAT(residualViews({{1, {{0, 0, 0}}, {{3.0, 0.0, 0.0}}, true}}, {}), HasSubstr("arrows 10 times"));
}

TEST(ResidualViews, NameAnOutlierAndDoNotLetItScale) {
  const std::string svg =
      residualViews({{1, {{0, 0, 0}}, {{0.2, 0, 0}}, true}, {4711, {{9, 9, 0}}, {{15, 0, 0}}, false}}, {});
  EXPECT_EQ(countOf(svg, ">4711<"), 2u);
  EXPECT_THAT(svg, HasSubstr("arrows 50 times"));
}

TEST(ErrorMapView, IsOneBandWhereTheErrorIsTheSame) {
  const std::string svg = errorMapView([](const auto&) { return 0.22; }, {});
  EXPECT_THAT(svg, HasSubstr(">0.22 to 0.23<"));
  EXPECT_THAT(svg, Not(HasSubstr("fill:rgb(77.6")));
  EXPECT_EQ(whatIsWrongWith(svg), "");
}

TEST(ErrorMapView, IsDarkerWhereTheErrorIsLarger) {
  const std::string svg = errorMapView([](const auto& p) { return p.mm.x < 0.0 ? 0.11 : 0.41; }, {{{0, 0, 30}}});
  // Bands of 0.05 mm from 0.10: left the first, right the seventh.
  EXPECT_TRUE(
      std::regex_search(svg, std::regex("fill:rgb\\(93.7\\d*%,95.2\\d*%,100%\\);[^\"]*\" d=\"M 50 26 L 306\\.")));
  EXPECT_TRUE(
      std::regex_search(svg, std::regex("fill:rgb\\(3.1\\d*%,27.0\\d*%,58.0\\d*%\\);[^\"]*\" d=\"M 306 26 L 562\\.")));
  EXPECT_EQ(countOf(svg, "stroke-width:1.2;"), 2u) << "a touch and the legend's";
}

TEST(HistoryView, RingsEveryAlarmOfItsQuantity) {
  const auto history = exampleHistory();
  const auto review = calibration::reviewOf(history);
  std::size_t rings_in_all = 0;
  for (const DriftQuantity quantity : calibration::kDriftQuantities) {
    const std::string svg = historyView(history, review, quantity);
    const auto alarms = std::ranges::count(review.alarms, quantity, &calibration::DriftAlarm::quantity);
    EXPECT_EQ(countOf(svg, "stroke-width:2.2;"), static_cast<std::size_t>(alarms));
    EXPECT_EQ(whatIsWrongWith(svg), "");
    rings_in_all += static_cast<std::size_t>(alarms);
  }
  EXPECT_GT(rings_in_all, 3u);
}

TEST(HistoryView, HasNoLimitsBeforeThereAreEnoughChecks) {
  auto history = exampleHistory();
  history.resize(5);
  EXPECT_THAT(historyView(history, calibration::reviewOf(history), DriftQuantity::rms), Not(HasSubstr("mean ")));
  history = exampleHistory();
  EXPECT_THAT(historyView(history, calibration::reviewOf(history), DriftQuantity::rms), HasSubstr("mean "));
}

TEST(HistoryView, WritesTheLimitThatItDraws) {
  const auto history = exampleHistory();
  const auto review = calibration::reviewOf(history);
  const auto& limits = review.limits[static_cast<std::size_t>(DriftQuantity::rms)];
  ASSERT_TRUE(limits);
  EXPECT_THAT(historyView(history, review, DriftQuantity::rms), HasSubstr("+3\u03c3 " + fixedText(limits->at(3.0), 2)));
}

}  // namespace
}  // namespace app
