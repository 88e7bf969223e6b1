#include "app/study/bundle/cif_report.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>

#include "app/report/html_page.h"
#include "app/report/markup.h"
#include "app/study/study_page.h"
#include "app/text/list.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string paragraphs(const std::vector<std::string>& lines) {
  std::string content;
  for (const std::string& line : lines)
    if (!line.empty()) content += "<p>" + escaped(line) + "</p>\n";
  return content;
}

/// What the sessions say of one thing: each once, with those that say it where they differ.
template <class Said>
std::string told(const std::vector<SessionAccount>& sessions, const Said& said) {
  std::map<std::string, std::vector<std::string>> by_words;
  for (const SessionAccount& one : sessions) by_words[said(one)].push_back(one.session.folder);
  std::string text;
  for (const auto& [words, folders] : by_words) {
    text += text.empty() ? "" : " · ";
    text += words.empty() ? "not recorded" : words;
    if (by_words.size() > 1) text += " (" + joined(folders) + ")";
  }
  return text;
}

std::string participantsSection(const std::vector<SessionAccount>& sessions) {
  Rows rows;
  std::map<std::string, std::set<std::string>> people;
  for (const SessionAccount& one : sessions) {
    people[one.group.empty() ? "no group" : one.group].insert(one.session.participant);
    std::vector<std::string> allowed;
    for (const auto& [stream, is_given] : one.consent)
      if (is_given) allowed.push_back(stream);
    rows.push_back(
        {one.session.participant, one.group, std::to_string(one.session.visit), one.evaluator, joined(allowed)});
  }
  std::vector<std::string> counts;
  for (const auto& [group, codes] : people) counts.push_back(fmt::format("{}: {}", group, codes.size()));
  return paragraphs({joined(counts, {}, "; ")}) +
         tableMarkup({"Participant", "Group", "Session", "Evaluator", "Allowed to be kept"}, rows);
}

std::string contextSection(const std::vector<SessionAccount>& sessions) {
  const auto verified = std::ranges::count_if(sessions, &SessionAccount::is_verified),
             hold = std::ranges::count_if(sessions, &SessionAccount::rules_hold);
  return tableMarkup({},
                     {{"Case", told(sessions, [](const auto& one) { return one.case_name; })},
                      {"Program", told(sessions, [](const auto& one) { return one.program; })},
                      {"Calibration of hand and eye", told(sessions, [](const auto& one) { return one.calibration; })},
                      {"Force, stereo, missed ticks", told(sessions, [](const auto& one) { return one.conditions; })},
                      {"Recordings verified by replay", fmt::format("{} of {}", verified, sessions.size())},
                      {"Rules the same in the recording", fmt::format("{} of {}", hold, sessions.size())}});
}

std::string tasksSection(const std::vector<SessionAccount>& sessions) {
  Rows rows;
  std::set<std::vector<std::string>> known;
  for (const SessionAccount& one : sessions)
    for (const TaskAccount& task : one.tasks) {
      std::vector<std::string> row{task.id, task.say, task.success, task.fail, assets::numberText(task.time_box_s)};
      if (known.insert(row).second) rows.push_back(std::move(row));
    }
  return rows.empty() ? "" : tableMarkup({"Task", "As it is told", "Success", "Failure", "Time box s"}, rows);
}

constexpr const char* kMeasures =
    "Success: share of those who succeeded, at 95 % by adjusted Wald. Time: geometric mean of those who succeeded, "
    "interval by its logarithm. Answers: mean and, from five on, standard deviation (n - 1). Problems: severity 0 to "
    "4, "
    "median of raters' worst, times the share of those who met the task. Groups and sessions: exact rank tests, "
    "adjusted by Holm.";

const std::vector<std::string> kBundleLimits{
    "A cooperative evaluation is formative: few participants, who know that somebody of the designers sits beside "
    "them. It finds problems; it is no independent assessment of quality (Monk and others 1993).",
    "Recordings hold hand, force and bone, no person: people are codes, whose key lies outside of the program.",
    "Molar is a training device, not a clinical one."};

}  // namespace

std::string cifPage(const CifReport& report) {
  std::set<std::string> people;
  for (const SessionAccount& one : report.sessions) people.insert(one.session.participant);
  HtmlPage page("Usability evaluation of Molar, in the Common Industry Format",
                escaped(fmt::format("ISO/IEC 25062 · {} participant{}, {} session{}", people.size(),
                                    people.size() == 1 ? "" : "s", report.sessions.size(),
                                    report.sessions.size() == 1 ? "" : "s")));
  page.section("Product", paragraphs({"Molar, a workstation on which a surgeon rehearses the removal of an impacted "
                                      "lower third molar by eye and hand."}));
  page.section("Goals", paragraphs({told(report.sessions, [](const auto& one) { return one.goal; })}));
  page.section("Participants", participantsSection(report.sessions));
  page.section("Context of use", contextSection(report.sessions));
  page.section("Tasks and rules", tasksSection(report.sessions));
  page.section("Measures", paragraphs({kMeasures}));
  for (const StudyResult& result : report.results) addResults(page, result);
  std::vector<std::string> limits = kBundleLimits;
  limits.insert(limits.end(), report.remarks.begin(), report.remarks.end());
  page.section("Limits", paragraphs(limits));
  return page.text("Made by molar study export; the manifest beside it has the SHA-256 of every file.");
}

}  // namespace app
