#include "app/calibrate/report/calibration_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/report/markup.h"
#include "tests/app/calibrate/report/example_record.h"
#include "tests/app/calibrate/report/markup.h"

namespace app {
namespace {

using calibration::RigRecord;
using calibration::Verdict;
using testing::HasSubstr;
using testing::Not;

const std::string kNow = "2027-01-05T08:00:00Z";

std::string page(const RigRecord& record) { return reportHtml(record, exampleHistory(), kNow); }

/// Without style and drawings.
std::string wordsIn(std::string html) {
  for (const auto& [from, to] : {std::pair("<style", "</style>"), std::pair("<svg", "</svg>"), std::pair("<", ">")})
    for (std::size_t at = html.find(from); at != std::string::npos; at = html.find(from))
      html.erase(at, html.find(to, at) + std::string(to).size() - at);
  return html;
}

TEST(CalibrationReport, BeginsWithVerdictAndTheOneSentence) {
  RigRecord record = exampleRecord();
  record.verification->worst = "worst: back left low, 0.9 mm";
  const std::string html = page(record);
  EXPECT_LT(html.find("Green: use it."), html.find("<table"));
  EXPECT_LT(html.find("Worst: back left low, 0.9 mm."), html.find("<table"));
  record.verification->verdict = Verdict::amber;
  EXPECT_THAT(page(record), HasSubstr("Amber: usable"));
  record.verification->verdict = Verdict::red;
  EXPECT_THAT(page(record), HasSubstr("Red: locked"));
  record.verification.reset();
  EXPECT_THAT(page(record), HasSubstr("Not verified"));
}

TEST(CalibrationReport, HoldsTheRecordsFigures) {
  const RigRecord record = exampleRecord();
  const std::string html = page(record);
  for (const double mm :
       {record.verification->errors.mean_mm, record.verification->errors.rms_mm, record.verification->errors.p95_mm,
        record.verification->errors.max_mm, record.procedure->cv_rms_mm, record.procedure->fre_rms_mm})
    EXPECT_THAT(html, HasSubstr(">" + fixedText(mm, 2) + " mm<"));
  EXPECT_THAT(html, HasSubstr("plausibility, no accuracy"));
  EXPECT_THAT(html, HasSubstr("\u2264 0.50 mm"));  // the limit it was judged by
  EXPECT_THAT(html, HasSubstr("<td>13</td>"));     // the wrong pit
  for (const char* origin : {"rig-02", "60623200012", "burr-3mm-07", "tech-07", "2026-11-21 08:20 UTC", "half silvered",
                             "jig27", "4.6.0", "45 days ago"})
    EXPECT_THAT(html, HasSubstr(origin));
}

TEST(CalibrationReport, SaysOfEachFigureHowItStands) {
  RigRecord record = exampleRecord();
  const calibration::VerificationLimit limit = calibration::limitsOf(record.verification->kind).max;
  const auto largestIs = [&](double mm) {
    record.verification->errors.max_mm = mm;
    const std::string html = page(record);
    const std::size_t row = html.find("&emsp;largest");
    return html.substr(row, html.find("</tr>", row) - row);
  };
  EXPECT_THAT(largestIs(limit.green_mm - 0.01), HasSubstr("green</span>"));
  EXPECT_THAT(largestIs(limit.green_mm + 0.01), HasSubstr("amber</span>"));
  EXPECT_THAT(largestIs(limit.amber_mm + 0.01), HasSubstr("red</span>"));
}

TEST(CalibrationReport, IsOneWholePageWithNothingFromElsewhere) {
  const std::string html = page(exampleRecord());
  EXPECT_EQ(whatIsWrongWith(html), "");
  EXPECT_EQ(countOf(html, "<svg"), 7u);  // verdict, arrows, map, four charts
  for (const char* outside : {"<script", "<link", "<img", "src=", "href=", "url(", "@import", "https:"})
    EXPECT_THAT(html, Not(HasSubstr(outside))) << outside;
  EXPECT_EQ(countOf(html, " id="), 0u);
  EXPECT_EQ(countOf(html, "http:"), countOf(html, "xmlns=\"http://www.w3.org/2000/svg\""));
}

TEST(CalibrationReport, TellsTheAlarmsOfTheHistory) {
  const std::string words = wordsIn(page(exampleRecord()));
  EXPECT_THAT(words, HasSubstr("Not steady: 2027-01-04"));
  EXPECT_THAT(words, HasSubstr("bias upwards 0.42 mm, beyond 3 sigma"));
  EXPECT_THAT(wordsIn(reportHtml(exampleRecord(), {}, kNow)), HasSubstr("No check yet"));
}

TEST(CalibrationReport, SaysThatItIsOld) {
  EXPECT_THAT(page(exampleRecord()), Not(HasSubstr("old: calibrate again")));
  EXPECT_THAT(reportHtml(exampleRecord(), {}, "2027-03-05T08:00:00Z"), HasSubstr("old: calibrate again"));
}

TEST(CalibrationReport, ReadsTextAsText) {
  RigRecord record = exampleRecord();
  const std::string evil = "<script>alert('1')</script>&\"";
  record.provenance = {evil, evil, evil, evil, evil, evil, 0.0, evil};
  record.rig.device = calibration::RigDevice{evil, evil, evil, evil};
  record.procedure->method = evil;
  record.verification->checked_utc = record.verification->worst = record.hash = evil;
  const std::string html = reportHtml(record, {}, evil);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(whatIsWrongWith(html), "");
}

TEST(CalibrationReport, IsWholeWhateverIsMissing) {
  EXPECT_EQ(whatIsWrongWith(reportHtml({}, {}, "")), "");
  RigRecord record = exampleRecord();
  record.verification->residuals.clear();
  record.residuals.clear();
  EXPECT_EQ(whatIsWrongWith(page(record)), "");
  record = exampleRecord();
  record.procedure.reset();
  EXPECT_EQ(whatIsWrongWith(page(record)), "");
  record = exampleRecord();
  for (auto& one : record.residuals) one.used = false;
  for (auto& one : record.verification->residuals) one.used = false;
  EXPECT_EQ(whatIsWrongWith(page(record)), "");
  for (std::size_t n = 0; n < 12; ++n) {
    auto history = exampleHistory();
    history.resize(n);
    EXPECT_EQ(whatIsWrongWith(reportHtml(record, history, kNow)), "");
  }
}

}  // namespace
}  // namespace app
