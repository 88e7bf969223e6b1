#include "app/review/review_page.h"

#include <gtest/gtest.h>

#include "app/review/review_figures.h"
#include "app/session/measures/clearance_measures.h"

namespace app {
namespace {

SessionReview someReview() {
  SessionReview review;
  review.metrics.patient_title = "built-in patient <right> & \"deep\"";
  review.metrics.program_version = "0.1.0";
  review.metrics.closed = true;
  review.metrics.duration_s = 102.0;
  review.metrics.removed_mm3_by_label = {{"cortical", 12.34}, {"unlabelled", 0.001}};
  review.metrics.measures = {{"M2.path", "way of the bur's centre", "mm", 31.4, {}, {}},
                             {"PI", "painting index", "", {}, "too few strokes in bone", {}},
                             {"S10.dry", "time drilling in bone without irrigation", "s", 5.0, {}, {}}};
  review.course.duration_s = 102.0;
  review.course.most_force_N.assign(204, 0.5);
  review.course.removed_mm3.assign(204, 1.0);
  review.course.force_s[2] = 3.0;
  review.course.tools = {{0.0, 102.0, "round 3.0 mm"}};
  review.course.marks = {{12.0, MarkKind::touch, "mandibular canal touched"}};
  review.why_no_plan = "the patient's folder was not named";
  render::Image image{4, 3, std::vector<std::uint8_t>(48, 200)};
  review.pictures = {{"from above", image}, {"from the cheek", image}};
  return review;
}

TEST(ReviewPage, IsOneFileWithoutScriptOrRequest) {
  const std::string page = reviewHtml(someReview());
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  for (std::size_t at = page.find("http:"); at != std::string::npos; at = page.find("http:", at + 1))
    EXPECT_TRUE(page.compare(at, 19, "http://www.w3.org/1") == 0 || page.compare(at, 19, "http://www.w3.org/2") == 0)
        << page.substr(at, 60) << " is more than the name of a language";
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
  EXPECT_EQ(page.find("file:"), std::string::npos);
}

TEST(ReviewPage, WordsOfACaseAreEscaped) {
  const std::string page = reviewHtml(someReview());
  EXPECT_EQ(page.find("<right>"), std::string::npos);
  EXPECT_NE(page.find("&lt;right&gt; &amp;"), std::string::npos);
}

TEST(ReviewPage, ErrorsAreYesNoOrNotKnown) {
  SessionReview review = someReview();
  EXPECT_NE(reviewHtml(review).find("<b>Not known</b>: Lingual plate broken through"), std::string::npos);
  EXPECT_NE(reviewHtml(review).find("<b>Not known</b>: Second molar touched"), std::string::npos);
  SocketRecord socket;
  socket.lingual = {{2.5, glm::dvec3(0.0)}};
  review.metrics.socket = socket;
  review.metrics.touched = {{"lower right second molar", 2, 0.8}, {"lower right third molar", 5, 9.0}};
  const std::string page = reviewHtml(review);
  EXPECT_NE(page.find("<b>Yes</b>: Lingual plate broken through<br><span class=\"quiet\">2.5 mm²"), std::string::npos);
  EXPECT_NE(page.find("<b>Yes</b>: Second molar touched by the bur<br><span class=\"quiet\">the bur was on it 2 times"),
            std::string::npos);
  EXPECT_NE(page.find("<b>No</b>: Tooth left in the socket"), std::string::npos);
  review.metrics.touched->erase(review.metrics.touched->begin());
  EXPECT_NE(reviewHtml(review).find("<b>No</b>: Second molar touched"), std::string::npos)
      << "the third molar is not its neighbour";
  EXPECT_NE(reviewHtml(review).find("<b>No</b>: Mandibular canal touched"), std::string::npos);
  review.metrics.measures.push_back({"S1.canal", "least clearance", "mm", {}, kNoStructure, {}});
  EXPECT_NE(reviewHtml(review).find("<b>Not known</b>: Mandibular canal touched"), std::string::npos)
      << "what is not there is not missed";
}

TEST(ReviewPage, WhatIsNotKnownSaysWhy) {
  const std::string page = reviewHtml(someReview());
  EXPECT_NE(page.find("not told: too few strokes in bone"), std::string::npos);
  EXPECT_NE(page.find("not told: the patient&#39;s folder was not named"), std::string::npos);
}

TEST(ReviewPage, AnotherRehearsalStandsBeside) {
  SessionMetrics other = someReview().metrics;
  other.measures[0].value = 77.7;
  const std::string page = reviewHtml(someReview(), {.other = &other});
  EXPECT_NE(page.find("<td>31.4 mm</td><td>77.7 mm</td>"), std::string::npos);
}

TEST(ReviewPage, AMomentLeadsToItsPicture) {
  SessionReview review = someReview();
  review.metrics.measures.push_back({"S1.canal", "least clearance to the mandibular canal", "mm", 1.25, {}, 40.0});
  review.metrics.measures.push_back({"S1.lingual", "least clearance", "mm", 3.5, {}, 70.0});
  const render::Image image{4, 3, std::vector<std::uint8_t>(48, 90)};
  review.moments = {{{12.0, "mandibular canal touched"}, 2.5, {{"as seen", image}}},
                    {{40.0, "nearest to the canal"}, 1.5, {{"as seen", image}}}};
  const std::string page = reviewHtml(review);
  EXPECT_NE(page.find("<figure id=\"picture-2\">"), std::string::npos);
  EXPECT_NE(page.find("<b>1.25 mm</b></td><td><a href=\"#picture-2\">0:40</a></td>"), std::string::npos);
  EXPECT_NE(page.find("<b>3.50 mm</b></td><td>1:10</td>"), std::string::npos) << "without a picture no link";
  EXPECT_NE(page.find("<a href=\"#picture-1\"><rect"), std::string::npos) << "from the time line";
  EXPECT_NE(page.find("</b> nearest to the canal; force 1.5 N"), std::string::npos);
}

TEST(ReviewPage, SpeaksOfTheCanalWhereTheCaseHasOne) {
  SessionReview review = someReview();
  review.metrics.touched.emplace();
  const auto told = [&review] { return reviewHtml(review).find("no tooth, no canal") != std::string::npos; };
  EXPECT_FALSE(told());
  review.has_canal = true;
  EXPECT_TRUE(told());
}

TEST(ReviewPage, WhatIsNotAsItWasIsSaidWithoutPictures) {
  SessionReview review = someReview();
  EXPECT_NE(reviewHtml(review).find("<td>Run again for the pictures</td><td>as recorded</td>"), std::string::npos);
  review.remarks = {"from tick 12 on: the force served differs"};
  EXPECT_NE(reviewHtml(review).find("from tick 12 on: the force served differs"), std::string::npos);
}

TEST(ReviewPage, PicturesHaveNoIdsThatClash) {
  // Of the same size, but not the same: each must be shown at its own place.
  EXPECT_EQ(reviewHtml(someReview()).find(" id=\"source"), std::string::npos);
  EXPECT_EQ(reviewHtml(someReview()).find(" id=\"image"), std::string::npos);
}

TEST(ReviewPage, TellsTheRunsOfTheCaseOverTime) {
  CaseTrend trend{"built-in patient", {}};
  for (int run = 0; run < 2; ++run) trend.runs.push_back({"a/path/of/somebody.molar", 86400 * run, {}});
  trend.runs[1].metrics = someReview().metrics;
  EXPECT_NE(reviewHtml(someReview(), {.trend = &trend}).find("this one is not among them"), std::string::npos)
      << "a session with the same measures is not this one";
  trend.runs[1].is_own = true;
  const std::string two = reviewHtml(someReview(), {.trend = &trend});
  EXPECT_NE(two.find("the square is this one. Median and range are told from 3 on."), std::string::npos);
  EXPECT_EQ(two.find("median</td>"), std::string::npos);
  EXPECT_NE(two.find("<td>1970-01-02 00:00 UTC</td>"), std::string::npos) << "as in the heading";
  EXPECT_EQ(two.find("somebody"), std::string::npos) << "no file";
  trend.runs.push_back({"c.molar", 0, {}});
  const std::string three = reviewHtml(someReview(), {.trend = &trend});
  EXPECT_NE(three.find("<td>median</td><td>0.00</td>"), std::string::npos);
  EXPECT_NE(three.find("<td>most</td><td>1.70</td>"), std::string::npos) << "102 s are 1.7 min";
}

TEST(ReviewPage, ASessionOfOneTickIsDrawn) {
  SessionReview review = someReview();
  review.course = {};
  review.pictures.clear();
  EXPECT_NE(reviewHtml(review).find("Timeline of the rehearsal"), std::string::npos);
  EXPECT_EQ(forceFigure(review.course), "");
  EXPECT_EQ(picturesFigure({}, ""), "");
}

}  // namespace
}  // namespace app
