#include "app/review/comparison_page.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/report/html_page.h"
#include "app/report/markup.h"
#include "app/review/review_figures.h"
#include "app/review/site_view.h"
#include "app/session/gates.h"
#include "app/station/session_patient.h"
#include "app/text/clock_text.h"
#include "assets/trilinear.h"

namespace app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

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
  const std::string mark = gate.is_open && !gate.is_confirmed ? ", not confirmed" : "";
  return said + mark + (gate.words.empty() ? "" : ": " + gate.words);
}

std::string orDash(const std::optional<double>& value) { return value ? shortText(*value) : "-"; }

std::string boneSection(const SessionComparison& c, const ComparisonPictures& pictures) {
  std::string content = tableMarkup({"Bone", "mm³"}, {{"removed by both", shortText(c.bone.both_mm3)},
                                                      {"by the first alone", shortText(c.bone.onlyInA_mm3())},
                                                      {"by the second alone", shortText(c.bone.onlyInB_mm3())},
                                                      {"overlap (Dice)", orDash(c.bone.dice())}});
  const std::size_t pairs = std::min(pictures.a.size(), pictures.b.size());
  if (pairs == 0) return content;
  // A figure for each, so that a printed page is filled and none is cut.
  content +=
      "<p>The site as it was left. Red: bone that this one cut and the other did not; blue: bone that stands "
      "here and the other cut.</p>\n<div class=\"pairs\">\n";
  for (std::size_t n = 0; n < pairs; ++n)
    content += figureMarkup(picturesFigure({{"", pictures.a[n].image}, {"", pictures.b[n].image}},
                                           "The site as both left it, " + pictures.a[n].from, false),
                            escaped("First and second, " + pictures.a[n].from));
  return content + "</div>\n";
}

std::string stepsSection(const SessionComparison& c) {
  Rows rows;
  for (const ComparedStep& step : comparedSteps(c))
    if (step.a_s > 0.0 || step.b_s.value_or(0.0) > 0.0)
      rows.push_back({step.title, clockText(step.a_s), clockText(step.b_s.value_or(0.0))});
  if (rows.empty()) return "";
  return figureMarkup(stepsFigure(c.a, c.b), "Steps of both over the same time.") +
         tableMarkup({"Step", "first", "second"}, rows);
}

std::string measuresSection(const SessionComparison& c) {
  Rows rows;
  for (const ComparedMeasure& row : comparedMeasures(c)) {
    if (isAmongMeasures(row.key) || (!row.a && !row.b)) continue;
    const std::string difference = row.a && row.b ? signedText(*row.b - *row.a, 2) : "-";
    rows.push_back({std::string(row.name) + (row.is_confirmed ? "" : ", not confirmed"), orDash(row.a), orDash(row.b),
                    difference, unitText(row.unit)});
    for (std::string& cell : rows.back())
      cell = row.is_confirmed ? escaped(cell) : "<span class=\"unconfirmed\">" + escaped(cell) + "</span>";
  }
  return tableOfMarkup({"Measure", "first", "second", "difference", ""}, rows);
}

}  // namespace

ComparisonPictures comparisonPictures(const ComparedEnds& ends) {
  const StoredStart& start = ends.start_a;
  const std::optional<assets::Patient> patient = patientOfSession(start, "");
  const SiteView site = siteViewOf(start, patient ? &*patient : nullptr, ends.left_a.solid);
  const auto pictures = [&](const BoneLeft& of, const BoneLeft& other) {
    return bonePictures({start.grid, start.label, start.solid, of.solid, of.laid ? &*of.laid : nullptr}, site,
                        fromRemoval(start, other.solid), {480, 420});
  };
  return {pictures(ends.left_a, ends.left_b), pictures(ends.left_b, ends.left_a)};
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
