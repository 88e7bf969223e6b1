#include "app/study/study_data.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "app/text/anonymous_id.h"
#include "app/text/list.h"
#include "assets/load_error.h"

namespace app {
namespace {

constexpr std::size_t kLongestName = 60, kLongestSentence = 2000;
constexpr std::array<std::string_view, 3> kResults{"success", "partly", "failed"};

/// One row of a table, cell by cell.
class Cells {
 public:
  Cells(const CsvTable& table, const CsvRow& row) : table_(table), row_(row) {}

  std::string participant() const {
    const std::string code = required("participant", kLongestName);
    if (!isAnonymousId(code)) refuse("participant", "give a code as P07, never a name");
    return code;
  }
  std::string required(std::string_view head, std::size_t longest) const {
    std::string text = optional(head, longest);
    if (text.empty()) refuse(head, "it is empty, fill it in");
    return text;
  }
  std::string optional(std::string_view head, std::size_t longest) const {
    if (!table_.has(head)) return "";
    const std::string& text = row_.cells[table_.column(head)];
    if (text.size() > longest) refuse(head, "it is longer than " + std::to_string(longest) + " bytes, shorten it");
    return text;
  }
  std::optional<double> number(std::string_view head, double low, double high) const {
    const std::string text = optional(head, kLongestName);
    if (text.empty()) return {};
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high))
      refuse(head, "\"" + shown(text) + "\" is no number from " + numberWords(low) + " to " + numberWords(high));
    return value;
  }
  std::optional<int> count(std::string_view head, int low, int high) const {
    const auto value = number(head, low, high);
    if (value && *value != std::floor(*value)) refuse(head, "give a whole number");
    return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
  }
  [[noreturn]] void refuse(std::string_view head, const std::string& reason) const {
    table_.refuse(row_, table_.column(head), reason);
  }

 private:
  static std::string shown(std::string text) {
    constexpr std::size_t kMostShown = 20;
    return text.size() > kMostShown ? text.substr(0, kMostShown) + "…" : text;
  }
  static std::string numberWords(double value) { return std::to_string(static_cast<long>(value)); }

  const CsvTable& table_;
  const CsvRow& row_;
};

void requireKnownHeads(const CsvTable& table, const std::set<std::string, std::less<>>& known) {
  for (const std::string& head : table.heads)
    if (!known.contains(head))
      throw assets::LoadError(table.where + " line 1: the column \"" + head + "\" is not known, the heads are " +
                              joined(known));
}

}  // namespace

std::vector<AnswerSheet> answersFrom(const CsvTable& table, const Questionnaire& questionnaire) {
  std::set<std::string, std::less<>> known{"participant", "group", "session"};
  std::size_t items = 0;
  for (const QuestionItem& item : questionnaire.items) known.insert(item.id), items += table.has(item.id) ? 1 : 0;
  requireKnownHeads(table, known);
  table.column("participant");
  if (items == 0)
    throw assets::LoadError(table.where + " line 1: no column is an item of " + questionnaire.id + ", the items are " +
                            joined(questionnaire.items, &QuestionItem::id));
  std::vector<AnswerSheet> sheets;
  std::set<std::pair<std::string, std::string>> seen;
  std::map<std::string, std::string> group_of;
  for (const CsvRow& row : table.rows) {
    const Cells cells(table, row);
    AnswerSheet sheet{
        cells.participant(), cells.optional("group", kLongestName), cells.optional("session", kLongestName), {}, {}};
    if (!seen.insert({sheet.participant, sheet.session}).second)
      cells.refuse("participant", sheet.participant + " has answered already in this session, keep one row");
    if (group_of.try_emplace(sheet.participant, sheet.group).first->second != sheet.group)
      cells.refuse("group", sheet.participant + " is in another group above");
    for (const QuestionItem& item : questionnaire.items) {
      if (questionnaire.isOfWords())
        sheet.words.push_back(cells.optional(item.id, kLongestSentence));
      else
        sheet.values.push_back(cells.number(item.id, questionnaire.lowOf(item), questionnaire.highOf(item)));
    }
    const bool has_session = !sheet.session.empty();
    if (!sheets.empty() && has_session == sheets.front().session.empty())
      cells.refuse("session", "name the session in every row, or in none");
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

std::vector<TaskRun> tasksFrom(const CsvTable& table) {
  requireKnownHeads(table, {"participant", "task", "result", "time_s", "helps"});
  std::vector<TaskRun> runs;
  std::set<std::pair<std::string, std::string>> seen;
  for (const CsvRow& row : table.rows) {
    const Cells cells(table, row);
    TaskRun run;
    run.participant = cells.participant();
    run.task = cells.required("task", kLongestName);
    const auto result = std::ranges::find(kResults, cells.required("result", kLongestName));
    if (result == kResults.end()) cells.refuse("result", "give one of " + joined(kResults));
    run.result = static_cast<TaskResult>(result - kResults.begin());
    run.time_s = cells.number("time_s", 0.0, 86'400.0);
    if (run.time_s && *run.time_s <= 0.0) cells.refuse("time_s", "a task takes longer than 0 s");
    run.helps = cells.count("helps", 0, 1000).value_or(0);
    if (!seen.insert({run.participant, run.task}).second)
      cells.refuse("task", run.participant + " has done it above, keep one row");
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<ProblemSeen> problemsFrom(const CsvTable& table) {
  requireKnownHeads(table, {"problem", "title", "participant", "task", "rater", "severity", "moment", "merged_into"});
  std::vector<ProblemSeen> evidence;
  std::map<std::string, std::string> title_of;
  for (const CsvRow& row : table.rows) {
    const Cells cells(table, row);
    ProblemSeen one;
    one.problem = cells.required("problem", kLongestName);
    one.title = cells.required("title", kLongestSentence);
    one.participant = cells.participant();
    one.task = cells.optional("task", kLongestName);
    one.rater = cells.optional("rater", kLongestName);
    if (!one.rater.empty() && !isAnonymousId(one.rater)) cells.refuse("rater", "give a code as E1, never a name");
    one.severity = cells.count("severity", 0, 4);
    one.moment = cells.optional("moment", kLongestName);
    one.merged_into = cells.optional("merged_into", kLongestName);
    if (title_of.try_emplace(one.problem, one.title).first->second != one.title)
      cells.refuse("title", "problem " + one.problem + " has another title above");
    evidence.push_back(std::move(one));
  }
  return evidence;
}

std::string blankAnswers(const Questionnaire& questionnaire) {
  std::vector<std::string> heads{"participant", "group", "session"}, row{"P01", "", ""};
  for (const QuestionItem& item : questionnaire.items) heads.push_back(item.id), row.emplace_back();
  return csvLine(heads) + csvLine(row);
}

std::string blankTasks() {
  return csvLine({"participant", "task", "result", "time_s", "helps"}) + csvLine({"P01", "trough", "success", "", "0"});
}

std::string blankProblems() {
  return csvLine({"problem", "title", "participant", "task", "rater", "severity", "moment"}) +
         csvLine({"1", "A sentence in the user's own terms", "P01", "trough", "E1", "2", ""});
}

}  // namespace app
