#include "app/review/review_page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/report/html_page.h"
#include "app/report/markup.h"
#include "app/review/preparation_page.h"
#include "app/review/review_figures.h"
#include "app/session/assessment_event.h"
#include "app/session/gates.h"
#include "app/text/clock_text.h"
#include "assets/tissue.h"

namespace app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kNotConfirmed = ", not confirmed";

/// Cells as markup, grey where they rest on what nobody has confirmed.
std::vector<std::string> cellsMarkup(std::vector<std::string> cells, bool is_confirmed) {
  for (std::string& cell : cells)
    cell = is_confirmed ? escaped(cell) : "<span class=\"unconfirmed\">" + escaped(cell) + "</span>";
  return cells;
}

std::string valueWords(const MeasureValue& measure) {
  if (!measure.value) return "not told: " + std::string(measure.why);
  // What is counted, a share of all or nothing.
  const bool is_whole = measure.unit.empty() && *measure.value == std::round(*measure.value);
  std::string words = is_whole ? fixedText(*measure.value, 0) : shortText(*measure.value);
  if (!measure.unit.empty()) words += " " + unitText(measure.unit);
  if (measure.t_s) words += " at " + clockText(*measure.t_s);
  if (!measure.is_confirmed) words += kNotConfirmed;
  return words;
}

std::string itemWords(const PlanItem& item) {
  return item.isKnown() ? valueText(item) + (item.is_confirmed ? "" : kNotConfirmed) : "not known: " + item.how;
}

/// Bone or tooth of this key in files, for people; empty: neither, the rim of what is soft.
std::string_view hardTissueName(const std::string& key) {
  const auto named = std::ranges::find(assets::kTissues, key, &assets::TissueProperties::key);
  return named == assets::kTissues.end() || !(named->hard || named->tooth) ? "" : named->name;
}

/// "Lingual plate broken through".
std::string begun(std::string_view name) {
  std::string words(name);
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

std::string caseSection(const SessionReview& review) {
  const assets::Proposed& proposed = review.metrics.proposed;
  Rows rows{{"Patient", escaped(review.metrics.patient_title)}};
  if (review.plan)
    for (const PlanItem& item : *review.plan)
      rows.push_back(cellsMarkup({std::string(item.name), itemWords(item)}, item.is_confirmed));
  else if (!isOfOneTooth(review))
    rows.push_back({"Plan", "not told: " + escaped(review.why_no_plan)});
  if (review.metrics.prediction)
    rows.push_back({"Predicted", escaped(predictionInWords(*review.metrics.prediction, review.metrics.endOfWork_s()))});
  if (const std::string drawn = review.metrics.drawn_cut ? drawnCutInWords(*review.metrics.drawn_cut) : "";
      !drawn.empty())
    rows.push_back(cellsMarkup({"Own plan", drawn + (proposed.tooth ? kNotConfirmed : "")}, !proposed.tooth));
  const std::string words = notConfirmedText(proposed);
  return (words.empty() ? "" : "<p class=\"unconfirmed\">" + escaped(begun(words)) + ", in grey.</p>\n") +
         tableOfMarkup({}, rows);
}

/// "2:39", leading to its picture where it has one.
std::string momentLink(const SessionReview& review, double t_s) {
  const auto shown = pictureOf(review.moments, t_s);
  return shown ? "<a href=\"#" + pictureId(*shown) + "\">" + clockText(t_s) + "</a>" : clockText(t_s);
}

/// When the event of a gate happened; none: it did not, or is of no moment.
std::optional<double> momentOf(const SessionReview& review, const Gate& gate) {
  if (!gate.is_open.value_or(false)) return {};
  for (const auto& [key, id] : {std::pair("perforation", "O5.area"), std::pair("second_molar", "O10.second_molar")})
    if (const MeasureValue* const measure = measureOf(review.metrics, id);
        gate.key == key && measure != nullptr && measure->value.value_or(0.0) > 0.0 && measure->t_s)
      return measure->t_s;
  for (const auto& [key, what] :
       {std::pair("second_molar", "second molar touched"), std::pair("canal", "mandibular canal touched")})
    for (const SessionMark& mark : review.course.marks)
      if (gate.key == key && mark.kind == MarkKind::touch && mark.what.ends_with(what)) return mark.t_s;
  return {};
}

std::string answer(const SessionReview& review, const Gate& gate, const std::string& question) {
  // Of what nobody has confirmed it is neither known that it happened nor that it did not.
  const bool is_grey = gate.is_open && !gate.is_confirmed;
  const std::string said = std::string(!gate.is_open   ? "Not known"
                                       : *gate.is_open ? "Yes"
                                                       : "No") +
                           (is_grey ? kNotConfirmed : "");
  std::string words = escaped(gate.words);
  if (const auto t_s = momentOf(review, gate); t_s && pictureOf(review.moments, *t_s))
    words += ", picture " + momentLink(review, *t_s);
  return std::string("<div class=\"verdict") + (is_grey ? " unconfirmed" : "") + "\">\n" +
         answerSymbol(is_grey ? std::nullopt : gate.is_open) + "<div><b>" + said + "</b>: " + escaped(question) +
         (words.empty() ? "" : "<br><span class=\"quiet\">" + words + "</span>") + "</div>\n</div>\n";
}

std::string errorsSection(const SessionReview& review) {
  std::string content = "<div class=\"beside\">\n";
  for (const Gate& gate : gatesOf(review.metrics)) content += answer(review, gate, begun(gate.name));
  return content + "</div>\n";
}

std::string againstSection(const SessionReview& review, const ReferenceSet& set) {
  Rows rows;
  for (const Score& score : scoresOf(review.metrics, set)) {
    if (score.better == 0) continue;
    rows.push_back(cellsMarkup({std::string(score.name) + (score.is_confirmed ? "" : kNotConfirmed),
                                fixedText(score.value, 2) + " " + unitText(score.unit), fixedText(score.median, 2),
                                fixedText(score.low, 2) + " to " + fixedText(score.high, 2),
                                score.z ? fmt::format("{:+.1f}", *score.z) : "-", score.better > 0 ? "more" : "less"},
                               score.is_confirmed));
  }
  return "<p>" +
         escaped(
             fmt::format("{}: {} runs of this case. The events above are never averaged away; one run has no grade.",
                         set.name, set.runs.size())) +
         "</p>\n" + tableOfMarkup({"Measure", "this rehearsal", "median", "range", "z", "better is"}, rows);
}

bool isSafety(const MeasureValue& measure) { return measure.id.starts_with("S"); }
bool isOutcome(const MeasureValue& measure) { return measure.id.starts_with("O"); }

/// Least clearance by structure, with force and speed then, and time in the bands that are measured.
std::string clearanceTable(const SessionReview& review) {
  Rows rows;
  const auto cell = [&](const std::string& id) {
    const MeasureValue* const measure = measureOf(review.metrics, id);
    return measure == nullptr || !measure->value ? std::string("-")
                                                 : shortText(*measure->value) + " " + escaped(unitText(measure->unit));
  };
  for (const auto& [id, name] :
       {std::pair("canal", "mandibular canal"), std::pair("lingual", "outer lingual surface"),
        std::pair("second_molar", "second molar"), std::pair("lingual_nerve", "lingual nerve's band (modelled)")}) {
    const std::string least = std::string("S1.") + id, near = std::string("S2.") + id;
    const MeasureValue* const measure = measureOf(review.metrics, least);
    if (measure == nullptr) continue;
    if (!measure->value) {
      rows.push_back({name, "not told: " + escaped(measure->why), "", "", "", "", "", ""});
      continue;
    }
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{
        name, "<b>" + cell(least) + "</b>", measure->t_s ? momentLink(review, *measure->t_s) : "",
        cell(least + "_force"), cell(least + "_speed"), cell(near + "_1mm"), cell(near + "_2mm"), cell(near + "_4mm")});
    if (measure->is_confirmed) continue;
    row[0] += kNotConfirmed;
    for (std::string& one : row) one = "<span class=\"unconfirmed\">" + one + "</span>";
  }
  if (rows.empty()) return "";
  return tableOfMarkup({"Turning bur to", "nearest", "at", "force then", "speed then", "below 1 mm", "2 mm", "4 mm"},
                       rows);
}

std::vector<std::string> measureRow(const MeasureValue& measure) {
  return cellsMarkup({std::string(measure.name), valueWords(measure)}, measure.is_confirmed || !measure.value);
}

std::string nearSection(const SessionReview& review) {
  const SessionMetrics& metrics = review.metrics;
  Rows rows;
  // Of work near lingual plate and second molar only what there was.
  const auto is_told = [](const MeasureValue& measure) {
    if (measure.id.starts_with("S1.") || measure.id.starts_with("S2.")) return false;
    const bool of_neighbour = measure.id.ends_with("molar") || measure.id.find("molar_") != std::string_view::npos ||
                              measure.id.find("lingual") != std::string_view::npos;
    return !of_neighbour || measure.value.value_or(0.0) != 0.0;
  };
  for (const MeasureValue& measure : metrics.measures)
    if (isSafety(measure) && is_told(measure)) rows.push_back(measureRow(measure));
  if (metrics.touched) {
    std::string words = !metrics.touched->empty() ? touchesText(*metrics.touched)
                        : review.has_canal        ? "no tooth, no canal"
                                                  : "no tooth";
    if (metrics.proposed.any()) words += kNotConfirmed;
    rows.push_back(cellsMarkup({"touched by the bur", words}, !metrics.proposed.any()));
  }
  const std::string cut = softTouchesText(metrics.soft_touches.cut),
                    pressed = softTouchesText(metrics.soft_touches.touched);
  rows.push_back({"bur turned on soft tissue", cut.empty() ? "never" : escaped(cut)});
  rows.push_back({"soft tissue pressed", pressed.empty() ? "never" : escaped(pressed)});
  return clearanceTable(review) + tableOfMarkup({}, rows);
}

std::string momentsSection(const SessionReview& review) {
  if (review.moments.empty()) return "";
  std::string content = "<div class=\"beside\">\n";
  for (std::size_t n = 0; n < review.moments.size(); ++n) {
    const auto& [moment, force_N, views] = review.moments[n];
    const std::string words =
        fmt::format("{} {}; force {} N", clockText(moment.t_s), moment.what, fixedText(force_N, 1));
    content += "<figure id=\"" + pictureId(n) + "\">\n" + picturesFigure(views, words, false) + "<figcaption><b>" +
               clockText(moment.t_s) + "</b> " + escaped(moment.what) + "; force " + fixedText(force_N, 1) +
               " N</figcaption></figure>\n";
  }
  const std::vector<BonePicture>& views = review.moments.front().views;
  std::string from;
  for (const BonePicture& view : views) from += (from.empty() ? "" : "; ") + view.from;
  return content + "</div>\n<p class=\"quiet\">Drawn from the recording run again. " +
         escaped("From left to right: " + from + ".") + "</p>\n";
}

std::string removedSection(const SessionReview& review) {
  Rows rows;
  const bool is_confirmed = !review.metrics.proposed.tooth;
  if (review.metrics.removed_mm3_by_label)
    for (const auto& [tissue, removed_mm3] : *review.metrics.removed_mm3_by_label)
      if (const std::string_view name = hardTissueName(tissue); !name.empty() && removed_mm3 >= 0.05)
        rows.push_back(
            cellsMarkup({std::string(name), fixedText(removed_mm3, 1) + " mm³" + (is_confirmed ? "" : kNotConfirmed)},
                        is_confirmed));
  // Outcomes of an extraction; those of one tooth are told apart.
  for (const MeasureValue& measure : review.metrics.measures)
    if (isOutcome(measure) && !isOfOneTooth(review)) rows.push_back(measureRow(measure));
  const std::string caption =
      review.is_against_plan
          ? "The site as it was left. Red: bone cut more than 0.3 mm outside of the plan of the gutter, blue: bone of "
            "the plan that stands. What sectioning and clearing took beyond the gutter is red, too."
          : "The site as it was left.";
  std::string content = tableOfMarkup({}, rows);
  if (review.pictures.empty()) return content;
  // Rows of two, so that a printed page is filled and none is cut.
  content += "<p>" + escaped(caption) + "</p>\n<div class=\"pairs\">\n";
  for (std::size_t n = 0; n < review.pictures.size(); n += 2) {
    const auto begin = review.pictures.begin() + static_cast<std::ptrdiff_t>(n);
    const std::vector<BonePicture> row(begin, begin + std::min<std::ptrdiff_t>(2, review.pictures.end() - begin));
    std::string from;
    for (const BonePicture& picture : row) from += (from.empty() ? "" : ", ") + picture.from;
    content += figureMarkup(picturesFigure(row, "The site as it was left, " + from, false), escaped(from));
  }
  return content + "</div>\n";
}

std::string handSection(const SessionReview& review, const SessionMetrics* other) {
  // What is judged first: the painting index, with what it is made of.
  std::vector<MeasureValue> measures = review.metrics.measures;
  std::stable_partition(measures.begin(), measures.end(),
                        [](const MeasureValue& measure) { return measure.id.starts_with("PI"); });
  Rows rows;
  for (const MeasureValue& measure : measures) {
    if (isSafety(measure) || isOutcome(measure)) continue;
    if (isOfOneTooth(review) && !measure.value) continue;
    std::vector<std::string> row = measureRow(measure);
    if (other != nullptr) {
      const MeasureValue* const same = measureOf(*other, measure.id);
      row.push_back(same == nullptr ? "" : escaped(valueWords(*same)));
    }
    rows.push_back(std::move(row));
  }
  std::vector<std::string> heads;
  if (other != nullptr) heads = {"Measure", "this rehearsal", "compared with"};
  std::string content = tableOfMarkup(heads, rows);
  if (const std::string force = forceFigure(review.course); !force.empty())
    content += figureMarkup(force, "How long the bur drilled in bone or tooth with which force.");
  return content;
}

std::string courseSection(const SessionReview& review) {
  std::string content = figureMarkup(timelineFigure(review.course, review.metrics.procedure, review.moments),
                                     "Instruments, drilling, force and removal; the numbers are those of the list, "
                                     "the blue marks below lead to the pictures.");
  if (!review.course.marks.empty()) {
    content += "<ol class=\"columns\">\n";
    int number = 0;
    for (const SessionMark& mark : review.course.marks)
      content +=
          "<li id=\"" + markId(++number) + "\">" + momentLink(review, mark.t_s) + " " + escaped(mark.what) + "</li>\n";
    content += "</ol>\n";
  }
  if (!review.metrics.procedure) return content;
  content += "<p>" + escaped(procedureInWords(*review.metrics.procedure)) + "</p>\n<ul>\n";
  for (const std::string& step : stepsInWords(*review.metrics.procedure)) content += "<li>" + escaped(step) + "</li>\n";
  return content + "</ul>\n";
}

std::string trendSection(const CaseTrend& trend) {
  const TrendTable table = trendTable(trend);
  std::vector<std::string> heads{"Rehearsal"};
  heads.insert(heads.end(), table.names.begin(), table.names.end());
  Rows rows;
  for (const auto* const part : {&table.runs, &table.spread})
    for (const TrendTable::Row& row : *part) {
      std::vector<std::string>& cells = rows.emplace_back(1, row.name);
      for (const auto& value : row.values) cells.push_back(value ? shortText(*value) : "-");
    }
  std::string words =
      fmt::format("{} of this case.", trend.runs.size() == 1 ? std::string("One rehearsal")
                                                             : fmt::format("{} rehearsals", trend.runs.size()));
  words += " Each dot is one, from old to new; ";
  words += std::ranges::any_of(trend.runs, &TrendRun::is_own) ? "the square is this one" : "this one is not among them";
  words += table.spread.empty() ? fmt::format(". Median and range are told from {} on.", kRunsForTrend)
                                : std::string(", the broken line is the median.");
  return figureMarkup(trendFigure(trend), escaped(words)) + tableMarkup(heads, rows);
}

std::string conditionsSection(const SessionReview& review) {
  const SessionMetrics& metrics = review.metrics;
  Rows rows{{"Program", metrics.program_version}, {"Force law", review.law}};
  rows.push_back({"Calibration", metrics.calibration ? calibrationText(*metrics.calibration) : "not recorded"});
  rows.push_back({"Assessment", !metrics.assessed   ? "not recorded"
                                : *metrics.assessed ? std::string(kAssessmentRules)
                                                    : fmt::format("no; the coach spoke {} times", metrics.coach_said)});
  rows.push_back({"Force, stereo", conditionsInWords(metrics.conditions)});
  rows.push_back({"Ticks of the force loop", fmt::format("{}, {} not recorded", metrics.ticks, metrics.lost)});
  rows.push_back({"Force clamped or slew-limited", fixedText(metrics.limited_s, 2) + " s"});
  rows.push_back({"Invalid pose, force or device fault", fixedText(metrics.faulty_s, 2) + " s"});
  rows.push_back({"Recording", metrics.closed ? "closed in order" : "ended early; complete up to then"});
  std::string again;
  for (const std::string& remark : review.remarks) again += (again.empty() ? "" : "; ") + remark;
  rows.push_back({"Run again for the pictures", again.empty() ? "as recorded" : again});
  if (metrics.former)
    rows.push_back({"Continues", fmt::format("an earlier rehearsal of {} before it; measures are of this part alone",
                                             clockText(metrics.former->duration_s))});
  return tableMarkup({}, rows);
}

}  // namespace

std::string reviewHtml(const SessionReview& review, const HeldAgainst& against) {
  const auto& [other, reference, trend] = against;
  std::string below = clockText(review.metrics.duration_s) + " min";
  if (!review.started_utc.empty()) below = timeText(review.started_utc) + " \u00b7 " + below;
  HtmlPage page("Rehearsal: " + review.metrics.patient_title, below);
  page.section("The case", caseSection(review));
  if (review.treatment)
    addTreatment(page, *review.treatment, !review.metrics.proposed.tooth);
  else if (review.preparation)
    addPreparation(page, *review.preparation);
  else
    page.section("Errors", errorsSection(review));
  if (reference != nullptr) page.section("Against the reference", againstSection(review, *reference));
  if (!isOfOneTooth(review)) page.section("How near, and on what", nearSection(review));
  page.section("These moments", momentsSection(review));
  page.section("Bone and tooth removed", removedSection(review));
  // With files alone there is no bur whose work would be told.
  if (!review.treatment || review.metrics.drill_on_s > 0.0) page.section("The hand's work", handSection(review, other));
  page.section("The course", courseSection(review));
  if (trend != nullptr) page.section("Over time", trendSection(*trend));
  page.section("Conditions", conditionsSection(review));
  return page.text(std::string("Measures as in molar metrics; ") +
                   (reference == nullptr ? "no score is given, for no reference was named"
                                         : "one run is scored by measure and never graded") +
                   ". A training device, not a clinical one.");
}

}  // namespace app
