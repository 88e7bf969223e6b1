#include "app/study/log_tables.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/study/csv.h"
#include "app/text/clock_text.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

/// To the millisecond, which is a tick.
std::string secondsOr(const std::optional<double>& value) {
  constexpr double kTicks_per_s = 1000.0;
  return value ? assets::exactText(std::round(*value * kTicks_per_s) / kTicks_per_s) : "";
}

std::string numberOr(const std::optional<double>& value) { return value ? assets::exactText(*value) : ""; }

/// A row of cells by the id of their task or item, the newest word.
using Answers = std::map<std::string, std::map<std::string, std::string>>;

std::string answersTable(const Questionnaire& questionnaire, const std::map<std::string, std::string>& answers,
                         const LogEvent& start) {
  std::vector<std::string> heads{"participant", "group", "session"};
  std::vector<std::string> row{start.textOr("participant"), start.textOr("group"), numberOr(start.number("visit"))};
  for (const QuestionItem& item : questionnaire.items) {
    heads.push_back(item.id);
    const auto found = answers.find(item.id);
    row.push_back(found == answers.end() ? "" : found->second);
  }
  return csvLine(heads) + csvLine(row);
}

}  // namespace

std::vector<SessionTable> logTables(const std::vector<const Questionnaire*>& asked, const std::vector<LogEvent>& events,
                                    const std::string& folder) {
  if (events.empty()) return {};
  const LogEvent& start = events.front();
  const std::string participant = start.textOr("participant");
  struct Run {
    std::string task, result, time_s, helps;
  };
  std::vector<Run> runs;
  std::string problems;
  Answers answers;
  std::optional<std::int64_t> tasks_began_ns;
  for (const LogEvent& event : events) {
    if (event.type == "phase" && event.textOr("phase") == "tasks") tasks_began_ns = event.t_ns;
    if (event.type == "task.stop")
      runs.push_back({event.textOr("task"), event.textOr("result"), secondsOr(event.number("time_s")),
                      numberOr(event.number("helps"))});
    if (event.type == "task.override") {
      const auto found = std::ranges::find(runs, event.textOr("task"), &Run::task);
      if (found != runs.end()) found->result = event.textOr("result");
    }
    // Words that are closed are no row.
    if (event.text("sealed") != nullptr) continue;
    if (event.type == "answer")
      answers[event.textOr("questionnaire")][event.textOr("item")] =
          event.text("words") != nullptr ? event.textOr("words") : numberOr(event.number("value"));
    if (event.type != "problem" || event.textOr("problem").empty()) continue;
    constexpr double kSecond_ns = 1e9;
    const std::string moment =
        tasks_began_ns ? folder + " " + clockText(static_cast<double>(event.t_ns - *tasks_began_ns) / kSecond_ns) : "";
    problems += csvLine({event.textOr("problem"), event.textOr("title"), participant, event.textOr("task"),
                         start.textOr("evaluator"), numberOr(event.number("severity")), moment});
  }
  std::vector<SessionTable> tables;
  if (!runs.empty()) {
    std::string text = csvLine({"participant", "task", "result", "time_s", "helps"});
    for (const Run& run : runs) text += csvLine({participant, run.task, run.result, run.time_s, run.helps});
    tables.push_back({"tasks.csv", std::move(text)});
  }
  if (!problems.empty())
    tables.push_back({"problems.csv",
                      csvLine({"problem", "title", "participant", "task", "rater", "severity", "moment"}) + problems});
  for (const Questionnaire* one : asked)
    if (const auto found = answers.find(one->id); found != answers.end())
      tables.push_back({"answers-" + one->id + ".csv", answersTable(*one, found->second, start)});
  return tables;
}

std::vector<SessionTable> logTables(const std::vector<LogEvent>& events, const std::string& folder) {
  std::vector<Questionnaire> answered;
  const std::vector<std::string> shipped = shippedQuestionnaires();
  for (const LogEvent& event : events) {
    if (event.type != "answer") continue;
    if (event.text("sealed") != nullptr) continue;
    const std::string id = event.textOr("questionnaire"), item = event.textOr("item");
    auto one = std::ranges::find(answered, id, &Questionnaire::id);
    if (one == answered.end()) {
      const bool is_shipped = std::ranges::find(shipped, id) != shipped.end();
      one = answered.insert(one, is_shipped ? questionnaireNamed(id) : Questionnaire{});
      one->id = id;
    }
    if (std::ranges::find(one->items, item, &QuestionItem::id) == one->items.end())
      one->items.push_back({item, "", "", "", {}});
  }
  std::vector<const Questionnaire*> asked;
  for (const Questionnaire& one : answered) asked.push_back(&one);
  return logTables(asked, events, folder);
}

}  // namespace app
