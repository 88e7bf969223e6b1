#include "app/review/comparison_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "app/report/html_page.h"
#include "app/report/markup.h"
#include "app/review/review_figures.h"
#include "app/review/site_view.h"
#include "app/session/gates.h"
#include "app/session/replay.h"
#include "app/station/session_patient.h"
#include "app/text/clock_text.h"
#include "assets/trilinear.h"

namespace app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

ReplayedState endOf(const std::string& path) {
  SessionReader session(path);
  return replayTo(session, std::numeric_limits<double>::infinity());
}

/// As a distance to a plan: -1 where all of what was there is gone, 1 where nothing is.
std::function<double(const glm::dvec3&)> fromRemoval(const StoredStart& start, const std::vector<std::uint8_t>& after) {
  return [&start, &after](const glm::dvec3& p_P_mm) {
    constexpr double kLeast = 0.1;
    const auto at = [&](const std::vector<std::uint8_t>& solid) {
      return assets::trilinearAt(start.grid, p_P_mm, [&](glm::ivec3 ijk) {
        return start.grid.contains(ijk) ? solid[start.grid.index(ijk)] / 255.0 : 0.0;
      });
    };
    const double was = at(start.solid);
    return was < kLeast ? 0.0 : 1.0 - 2.0 * (was - at(after)) / was;
  };
}

std::string eventWords(const Gate& gate) {
  const std::string said = !gate.is_open ? "not known" : *gate.is_open ? "yes" : "no";
  return gate.words.empty() ? said : said + ": " + gate.words;
}

std::string shortText(const std::optional<double>& value) {
  if (!value) return "-";
  return fixedText(*value, std::abs(*value) < 10.0 ? 2 : std::abs(*value) < 100.0 ? 1 : 0);
}

std::string boneSection(const SessionComparison& c, const ComparisonPictures& pictures) {
  std::string content = tableMarkup({"Bone", "mm³"}, {{"removed by both", shortText(c.bone.both_mm3)},
                                                      {"by the first alone", shortText(c.bone.onlyInA_mm3())},
                                                      {"by the second alone", shortText(c.bone.onlyInB_mm3())},
                                                      {"overlap (Dice)", shortText(c.bone.dice())}});
  std::vector<BonePicture> pairs;
  for (std::size_t n = 0; n < std::min(pictures.a.size(), pictures.b.size()); ++n) {
    pairs.push_back({"first, " + pictures.a[n].from, pictures.a[n].image});
    pairs.push_back({"second, " + pictures.b[n].from, pictures.b[n].image});
  }
  if (pairs.empty()) return content;
  return content + figureMarkup(picturesFigure(pairs, "The site as both left it"),
                                "The site as it was left. Red: bone that this one cut and the other did not; blue: "
                                "bone that stands here and the other cut.");
}

std::string stepsSection(const SessionComparison& c) {
  if (!c.a.procedure || !c.b.procedure) return "";
  Rows rows;
  for (const StepRecord& step : c.a.procedure->steps) {
    const auto same = std::ranges::find(c.b.procedure->steps, step.key, &StepRecord::key);
    const double other_s = same == c.b.procedure->steps.end() ? 0.0 : same->duration_s;
    if (step.duration_s > 0.0 || other_s > 0.0)
      rows.push_back({step.title, clockText(step.duration_s), clockText(other_s)});
  }
  return figureMarkup(stepsFigure(c.a, c.b), "Steps of both over the same time.") +
         tableMarkup({"Step", "first", "second"}, rows);
}

std::string measuresSection(const SessionComparison& c) {
  Rows rows;
  for (const ComparedMeasure& row : comparedMeasures(c)) {
    if (isAmongMeasures(row.key) || (!row.a && !row.b)) continue;
    const std::string difference = row.a && row.b ? signedText(*row.b - *row.a, 2) : "-";
    rows.push_back({std::string(row.name), shortText(row.a), shortText(row.b), difference, unitText(row.unit)});
  }
  return tableMarkup({"Measure", "first", "second", "difference", ""}, rows);
}

}  // namespace

ComparisonPictures comparisonPictures(const std::string& path_a, const std::string& path_b) {
  const ReplayedState a = endOf(path_a), b = endOf(path_b);
  const std::vector<std::uint8_t> whole_a = boneAtTime(path_a, {}).solid, whole_b = boneAtTime(path_b, {}).solid;
  const SiteView site = siteViewOf(a.start, patientOfSession(a.start, ""), whole_a);
  const auto pictures = [&](const ReplayedState& of, const std::vector<std::uint8_t>& other) {
    const std::vector<std::uint8_t> in_mouth = of.bodies.solidInMouth();
    return bonePictures({of.start.grid, of.start.label, of.start.solid, in_mouth}, site, fromRemoval(of.start, other),
                        {480, 420});
  };
  return {pictures(a, whole_b), pictures(b, whole_a)};
}

std::string comparisonHtml(const SessionComparison& c, const ComparisonPictures& pictures) {
  HtmlPage page("Two rehearsals: " + c.a.patient_title,
                clockText(c.a.duration_s) + " min and " + clockText(c.b.duration_s) + " min");
  Rows events;
  const auto first = gatesOf(c.a), second = gatesOf(c.b);
  for (std::size_t n = 0; n < first.size(); ++n)
    events.push_back({std::string(first[n].name), eventWords(first[n]), eventWords(second[n])});
  page.section("Errors", tableMarkup({"", "first", "second"}, events));
  page.section("Bone that only one took", boneSection(c, pictures));
  page.section("Steps", stepsSection(c));
  page.section("Measures", measuresSection(c));
  page.section("Conditions",
               tableMarkup({"", "first", "second"},
                           {{"Program", c.a.program_version, c.b.program_version},
                            {"Force, stereo", conditionsInWords(c.a.conditions), conditionsInWords(c.b.conditions)}}));
  return page.text("Measures as in molar metrics. A training device, not a clinical one.");
}

}  // namespace app
