#include "app/study/study_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/html_page.h"
#include "app/report/markup.h"
#include "app/text/list.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::string_view kLimits =
    "A cooperative evaluation is formative: few people, who know that a designer sits beside them. It finds problems; "
    "it "
    "does not prove quality.";
constexpr std::string_view kNoDeviation = "Below five values there is no deviation: the answers themselves are listed.";

std::string fixedOr(const std::optional<double>& value, int digits) { return value ? fixedText(*value, digits) : "–"; }

std::string rangeText(const std::optional<ValueRange>& range, int digits) {
  return range ? fixedText(range->low, digits) + "\u2060–\u2060" + fixedText(range->high, digits) : "–";
}

std::string percentText(double share) { return fixedText(100.0 * share, 0) + "\u00a0%"; }
std::string percentRange(const std::optional<ValueRange>& range) {
  return range ? fixedText(100.0 * range->low, 0) + "–" + percentText(range->high) : "–";
}

std::string groupText(const AnswerRow& row) {
  return row.session.empty() ? row.group : row.group + ", session " + row.session;
}

std::string valuesText(const std::vector<double>& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + assets::numberText(value);
  return list.empty() ? "no answer" : list;
}

std::string pText(double p) { return p < 0.001 ? "< 0.001" : fixedText(p, 3); }

std::vector<std::string> summaryCells(const AnswerRow& row) {
  const Summary& summary = row.summary;
  return {std::to_string(summary.count),
          fixedOr(summary.mean, 2),
          row.hasDeviation() ? fixedOr(summary.deviation, 2) : valuesText(row.values),
          fixedOr(summary.median, 1),
          fixedOr(summary.low, 0),
          fixedOr(summary.high, 0),
          rangeText(row.mean_interval, 2),
          row.missing == 0 ? "" : std::to_string(row.missing)};
}

constexpr std::string_view kImpossible = "\u2020";

/// N, mean and deviation of another study, as it printed them; a dagger where no answers can have them.
std::string publishedText(const AnswerRow& row) {
  if (!row.published) return "";
  const PublishedSummary& published = *row.published;
  return fmt::format("{}:\u00a0{}\u00a0±\u00a0{}{}", published.count, fixedOr(published.mean, 2),
                     fixedOr(published.deviation, 2), row.can_be_answered ? "" : kImpossible);
}

const std::vector<std::string> kSummaryHeads{"N",   "Mean", "Standard deviation", "Median",
                                             "Min", "Max",  "95 % of the mean",   "Missing"};

/// Where something is published it stands in grey beside count, mean and deviation.
std::string answerTable(const std::vector<const AnswerRow*>& shown, bool has_groups) {
  constexpr std::size_t kPublishedAfter = 3;
  const bool has_published =
      std::ranges::any_of(shown, [](const AnswerRow* row) { return row->published.has_value(); });
  std::vector<std::string> heads = kSummaryHeads;
  if (has_published) heads.insert(heads.begin() + kPublishedAfter, "Published");
  heads.insert(heads.begin(), "Item");
  if (has_groups) heads.insert(heads.begin() + 1, "Group");
  Rows rows_markup;
  std::string above;
  for (const AnswerRow* row : shown) {
    std::vector<std::string> cells = summaryCells(*row);
    for (std::string& cell : cells) cell = escaped(cell);
    if (has_published)
      cells.insert(cells.begin() + kPublishedAfter,
                   row->published ? "<span class=\"quiet\">" + escaped(publishedText(*row)) + "</span>" : "");
    cells.insert(cells.begin(), row->says == above ? "" : escaped(row->says));
    above = row->says;
    if (has_groups) cells.insert(cells.begin() + 1, escaped(groupText(*row)));
    rows_markup.push_back(std::move(cells));
  }
  return tableOfMarkup(heads, rows_markup);
}

/// What the grey columns are, and why some of them cannot be.
std::string publishedWords(const StudyResult& result) {
  const auto published = [](const AnswerRow& row) { return row.published.has_value(); };
  const auto first = std::ranges::find_if(result.items, published);
  if (first == result.items.end()) return "";
  std::string words = fmt::format("Published, in grey: N, mean ± standard deviation of {}.", result.source);
  if (std::ranges::any_of(result.items, [](const AnswerRow& row) { return !row.can_be_answered; }))
    words += fmt::format(" {} No {} whole answers on this scale have this mean and deviation, rounded to two digits.",
                         kImpossible, first->published->count);
  return result.published_note.empty() ? words : words + " " + result.published_note;
}

std::string answersSections(const StudyResult& result) {
  const bool has_groups = result.groups.size() > 1 || result.sessions.size() > 1;
  std::string content;
  std::vector<const AnswerRow*> whole;
  for (const AnswerRow& row : result.categories) whole.push_back(&row);
  for (const AnswerRow& row : result.scores) whole.push_back(&row);
  if (!whole.empty())
    content += "<h3>" + std::string(result.scores.empty() ? "By category: each participant's mean" : "Score") +
               "</h3>\n" + answerTable(whole, has_groups);
  std::vector<std::string> categories;
  for (const AnswerRow& row : result.items)
    if (std::ranges::find(categories, row.category) == categories.end()) categories.push_back(row.category);
  for (const std::string& category : categories) {
    std::vector<const AnswerRow*> shown;
    for (const AnswerRow& row : result.items)
      if (row.category == category) shown.push_back(&row);
    content +=
        "<h3>" + escaped(category.empty() ? result.title : category) + "</h3>\n" + answerTable(shown, has_groups);
  }
  if (const std::string words = publishedWords(result); !words.empty())
    content += "<p class=\"quiet\">" + escaped(words) + "</p>\n";
  return content;
}

std::string saidSection(const StudyResult& result) {
  Rows rows;
  for (const SaidAnswer& said : result.said) rows.push_back({said.item, said.participant, said.words});
  return rows.empty() ? "" : tableMarkup({"Question", "Participant", "Answer"}, rows);
}

std::string differencesSection(const StudyResult& result) {
  if (result.differences.empty())
    return result.groups.size() != 2 && result.sessions.size() != 2
               ? ""
               : "<p>Nothing is compared: each side needs five values, and some pair has to differ.</p>\n";
  Rows rows;
  for (const Difference& difference : result.differences)
    rows.push_back({difference.id, difference.words(), std::to_string(difference.count),
                    signedText(difference.test.shift, 2), rangeText(difference.test.shift_interval, 2),
                    signedText(difference.test.rank_biserial, 2), pText(difference.test.p), pText(difference.holm_p)});
  const char* test = result.differences.front().is_paired ? "Wilcoxon's signed ranks" : "Mann and Whitney's rank sums";
  return "<p>" +
         escaped(
             fmt::format("{}, two-sided, exact with ties up to 60 values; {} tests, adjusted by Holm. Shift: Hodges "
                         "and Lehmann's.",
                         test, result.differences.size())) +
         "</p>\n" + tableMarkup({"Item", "", "N", "Shift", "Shift, 95 %", "Rank-biserial", "p", "p, adjusted"}, rows);
}

std::string taskTable(const StudyResult& result) {
  Rows rows;
  for (const TaskRow& row : result.tasks)
    rows.push_back({row.task, std::to_string(row.count), std::to_string(row.success), std::to_string(row.partly),
                    std::to_string(row.failed), percentRange(row.success_share), fixedOr(row.time_s, 0),
                    rangeText(row.time_interval_s, 0), std::to_string(row.helps)});
  return rows.empty() ? ""
                      : tableMarkup({"Task", "N", "Success", "Partly", "Failed", "Success, 95 %", "Time s",
                                     "Time, 95 % s", "Helps"},
                                    rows) +
                            "<p class=\"quiet\">Time: geometric mean of those who succeeded.</p>\n";
}

/// "trough 3, open 1": participants who met it there.
std::string tasksText(const ProblemRow& row) {
  return joined(row.tasks, [](const MetInTask& one) { return one.task + " " + std::to_string(one.met_by); });
}

std::string problemTable(const StudyResult& result) {
  Rows rows;
  for (const ProblemRow& row : result.problems)
    rows.push_back({row.title + (row.also.empty() ? "" : " (also " + joined(row.also) + ")"), fixedOr(row.severity, 1),
                    fmt::format("{} of {}", row.met_by, row.could_meet), percentRange(row.share),
                    joined(row.participants), tasksText(row), joined(row.moments)});
  return rows.empty()
             ? ""
             : tableMarkup({"Problem", "Severity", "Met by", "Share, 95 %", "Participants", "Tasks", "Moments"}, rows);
}

std::string discoveryWords(const StudyResult& result) {
  if (result.problems.empty()) return "";
  if (!result.discovery) return "How many more participants are worth it: too few to say.";
  const Discovery& found = *result.discovery;
  return fmt::format(
      "One participant meets a problem with a chance of {}, corrected for few participants (Lewis 2001): about {} of "
      "all "
      "problems are found, and {} participants would find 85 %. Problems differ in how common they are, so the true "
      "share is lower.",
      fixedText(found.chance, 2), percentText(found.found_share), found.needed_85);
}

std::string agreementWords(const StudyResult& result) {
  if (!result.awaited.empty())
    return joined(result.awaited) + ": not all problems are rated yet; severities are shown once they are.";
  const SeverityAgreement& found = result.agreement;
  if (!found.ordinal)
    return found.raters < 2 ? "" : "Agreement of raters on severity: too little to say, or all severities are equal.";
  std::string words =
      fmt::format("Agreement of raters on severity: Krippendorff's alpha {} ({}; {} samples, seed {}){}",
                  fixedText(*found.ordinal, 2), rangeText(found.ordinal_interval, 2), kAlphaSamples,
                  SeverityAgreement::kSeed, *found.ordinal < 0.667 ? ", too low to rely on." : ".");
  if (found.intraclass)
    words +=
        fmt::format(" Intraclass correlation ICC(2,1) {} ({}), ICC(3,1) {} ({}).",
                    fixedText(found.intraclass->agreement, 2), rangeText(found.intraclass->agreement_interval, 2),
                    fixedText(found.intraclass->consistency, 2), rangeText(found.intraclass->consistency_interval, 2));
  return words;
}

std::string paragraph(const std::string& words) { return words.empty() ? "" : "<p>" + escaped(words) + "</p>\n"; }

}  // namespace

void addResults(HtmlPage& page, const StudyResult& result) {
  page.section("Problems",
               problemTable(result) + paragraph(discoveryWords(result)) + paragraph(agreementWords(result)));
  page.section("Tasks", taskTable(result));
  page.section("Answers", answersSections(result));
  page.section("In their words", saidSection(result));
  page.section("Compared", differencesSection(result));
}

std::string studyPage(const StudyResult& result) {
  HtmlPage page(result.title.empty() ? "Study" : result.title,
                escaped(fmt::format("{} participant{}{}", result.participants, result.participants == 1 ? "" : "s",
                                    result.groups.empty() ? "" : ", groups: " + joined(result.groups))));
  addResults(page, result);
  page.section("Limits", paragraph(std::string(kLimits)) + paragraph(std::string(kNoDeviation)) +
                             paragraph(result.source.empty() ? "" : "Questionnaire: " + result.source + "."));
  return page.text("Made by molar study; numbers by its --json and --csv.");
}

std::string studyLines(const StudyResult& result) {
  std::string lines = fmt::format("{} participant{}\n", result.participants, result.participants == 1 ? "" : "s");
  const auto table = [&](const std::string& head, const std::vector<AnswerRow>& rows) {
    if (rows.empty()) return;
    lines += fmt::format("\n{:<46} {:<18} {:>3} {:>6} {:>6} {:>6}\n", head, "group", "N", "mean", "SD", "median");
    for (const AnswerRow& row : rows)
      lines += fmt::format("{:<46.46} {:<18.18} {:>3} {:>6} {:>6} {:>6}\n", row.says, groupText(row), row.summary.count,
                           fixedOr(row.summary.mean, 2), row.hasDeviation() ? fixedOr(row.summary.deviation, 2) : "–",
                           fixedOr(row.summary.median, 1));
  };
  table("item", result.items);
  table("category", result.categories);
  table("score", result.scores);
  for (const SaidAnswer& said : result.said)
    lines += fmt::format("{} {}: {}\n", said.participant, said.item, said.words);
  for (const Difference& difference : result.differences)
    lines += fmt::format("{} {}: shift {}, p {}, adjusted {}\n", difference.id, difference.words(),
                         signedText(difference.test.shift, 2), pText(difference.test.p), pText(difference.holm_p));
  for (const TaskRow& row : result.tasks)
    lines += fmt::format("\ntask {}: {} of {} succeeded ({} at 95 %), {} partly, {} failed, {} s, {} helps", row.task,
                         row.success, row.count, percentRange(row.success_share), row.partly, row.failed,
                         fixedOr(row.time_s, 0), row.helps);
  if (!result.tasks.empty()) lines += "\n";
  for (const ProblemRow& row : result.problems)
    lines += fmt::format("\nproblem {}: {} · severity {}, met by {} of {}", row.problem, row.title,
                         fixedOr(row.severity, 1), row.met_by, row.could_meet);
  if (!result.problems.empty()) lines += "\n" + discoveryWords(result) + "\n";
  if (const std::string words = agreementWords(result); !words.empty()) lines += words + "\n";
  return lines;
}

std::string questionnaireSheet(const Questionnaire& questionnaire) {
  HtmlPage page(questionnaire.title, "Participant ______  Group ____________  Date of the session ____________");
  if (questionnaire.isOfWords()) {
    for (const QuestionItem& item : questionnaire.items)
      page.section(item.says, "<p style=\"height:7em;border-bottom:1px solid #999\"></p>\n");
    return page.text(questionnaire.source);
  }
  const int steps = questionnaire.high - questionnaire.low;
  const bool is_wide = steps > 10;
  std::string legend;
  if (questionnaire.scale.size() == 2) {
    legend = fmt::format("{} {} … {} {}", questionnaire.low, questionnaire.scale[0], questionnaire.high,
                         questionnaire.scale[1]);
  } else {
    for (std::size_t n = 0; n < questionnaire.scale.size(); ++n)
      if (!questionnaire.scale[n].empty())
        legend += (legend.empty() ? "" : " · ") +
                  fmt::format("{} {}", questionnaire.low + static_cast<int>(n), questionnaire.scale[n]);
  }
  page.add("<p>" + escaped(legend) + "</p>\n");
  std::vector<std::string> heads{""};
  for (int n = 0; n <= (is_wide ? 0 : steps); ++n)
    heads.push_back(is_wide ? fmt::format("{} to {}", questionnaire.low, questionnaire.high)
                            : std::to_string(questionnaire.low + n));
  std::vector<std::string> categories = questionnaire.categories();
  if (categories.empty()) categories.emplace_back();
  for (const std::string& category : categories) {
    Rows rows;
    for (const QuestionItem& item : questionnaire.items) {
      if (item.category != category || !item.choices.empty()) continue;
      std::vector<std::string> cells{item.says};
      cells.resize(heads.size(), is_wide ? "______" : "☐");
      rows.push_back(std::move(cells));
    }
    page.section(category.empty() ? "Please answer each line" : category, tableMarkup(heads, rows));
  }
  Rows pairs;
  for (const QuestionItem& item : questionnaire.items)
    if (!item.choices.empty()) pairs.push_back({"☐ " + item.choices[0], "☐ " + item.choices[1]});
  if (!pairs.empty()) page.section("Which of the two added more to the workload?", tableMarkup({"1", "2"}, pairs));
  return page.text(questionnaire.source);
}

}  // namespace app
