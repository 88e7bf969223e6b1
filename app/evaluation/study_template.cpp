#include "app/evaluation/study_template.h"

#include <algorithm>
#include <exception>
#include <set>
#include <utility>

#include "app/case/case.h"
#include "app/evaluation/task_measures.h"
#include "app/options/feel_preset.h"
#include "app/options/tool_text.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/synthetic/practice_block.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

constexpr std::size_t kMostTasks = 20, kMostPrompts = 20, kMostQuestionnaires = 10, kMostGroups = 10;
constexpr std::size_t kLongestName = 24, kLongestSaying = 300;
constexpr double kShortestBox_s = 1.0, kLongestBox_s = 3600.0;

std::string wordsFrom(assets::TomlReader& keys, const std::string& table, const std::string& key,
                      std::size_t longest = kLongestSaying) {
  std::string words = keys.text(table, key);
  if (words.empty() || words.size() > longest)
    keys.refuse(table, key, "give 1 to " + std::to_string(longest) + " bytes of text in quotes");
  return words;
}

/// Small letters, digits and '-', so that it may stand in tables and names.
void refuseUnlessPlain(const assets::TomlReader& keys, const std::string& table, const std::string& key,
                       const std::string& id) {
  const bool is_plain = !id.empty() && id.size() <= kLongestName && std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!is_plain)
    keys.refuse(table, key, "give 1 to " + std::to_string(kLongestName) + " small letters a to z, digits or '-'");
}

std::string idFrom(assets::TomlReader& keys, const std::string& table, std::set<std::string>& known) {
  const std::string id = keys.text(table, "id");
  refuseUnlessPlain(keys, table, "id", id);
  if (!known.insert(id).second) keys.refuse(table, "id", "another one has this id, give each its own");
  return id;
}

Rule ruleFrom(assets::TomlReader& keys, const std::string& table, const std::string& key) {
  const std::string text = keys.text(table, key);
  try {
    return Rule::from(text, ruleMeasures());
  } catch (const RuleError& error) {
    keys.refuse(table, key, error.what());
  }
}

TaskTemplate taskFrom(assets::TomlReader& keys, const std::string& table, std::set<std::string>& known) {
  TaskTemplate task;
  task.id = idFrom(keys, table, known);
  // Words of the script for what is no task.
  constexpr std::array<std::string_view, 6> kPhases{"prepare", "consent",        "warm-up",
                                                    "debrief", "questionnaires", "close"};
  if (std::ranges::find(kPhases, task.id) != kPhases.end())
    keys.refuse(table, "id", "\"" + task.id + "\" is a phase of every session, give another");
  task.say = wordsFrom(keys, table, "say");
  task.tool = keys.text(table, "tool", "");
  if (!task.tool.empty()) try {
      toolFrom(task.tool, "");
    } catch (const UsageError& error) {
      keys.refuse(table, "tool", error.what());
    }
  task.time_box_s = keys.number(table, "time_box_s", {kShortestBox_s, kLongestBox_s, "s"});
  if (!keys.has(table, "success"))
    keys.refuse(table, "success", "a task needs a rule for success, like \"O1.removed >= 20 mm3\"");
  task.success = ruleFrom(keys, table, "success");
  if (keys.has(table, "fail")) task.fail = ruleFrom(keys, table, "fail");
  task.hold_s = keys.number(table, "hold_s", {0.0, 60.0, "s"}, 0.0);
  task.at_time_box = static_cast<AtTimeBox>(keys.choice(table, "at_time_box", {"ask", "partly", "failed"}, 0));
  return task;
}

AskedQuestionnaire questionnaireFrom(assets::TomlReader& keys, const std::string& table) {
  AskedQuestionnaire asked;
  asked.use = wordsFrom(keys, table, "use");
  try {
    asked.questionnaire = questionnaireNamed(asked.use);
  } catch (const std::exception& error) {
    keys.refuse(table, "use", error.what());
  }
  if (keys.has(table, "groups")) asked.groups = keys.texts(table, "groups", kMostGroups);
  for (const std::string& group : asked.groups) refuseUnlessPlain(keys, table, "groups", group);
  return asked;
}

void readCase(assets::TomlReader& keys, StudyTemplate& made) {
  if (!keys.has("", "case")) return;
  made.case_name = keys.text("", "case");
  const std::vector<std::string> known = rehearsalNames();
  if (std::ranges::find(known, made.case_name) == known.end())
    keys.refuse("", "case", "there is no such case, give one of " + joined(known));
}

void readOperation(assets::TomlReader& keys, StudyTemplate& made) {
  if (!keys.has("operation")) return;
  constexpr const char* kTable = "operation";
  OperationTemplate& operation = made.operation;
  constexpr std::array<std::string_view, 3> kTasks{"", "root-canal", "preparation"};
  if (keys.has(kTable, "task")) operation.task = kTasks[1 + keys.choice(kTable, "task", {kTasks[1], kTasks[2]})];
  if (keys.has(kTable, "tooth")) operation.tooth = static_cast<int>(keys.integer(kTable, "tooth", 11, 48));
  if (operation.task.empty() && operation.tooth)
    keys.refuse(kTable, "tooth", "is for task root-canal or preparation, name it");
  for (const auto& [key, kept] : {std::pair{"ideal", &operation.ideal}, std::pair{"caries", &operation.caries}}) {
    if (!keys.has(kTable, key)) continue;
    if (operation.task != kTasks[2]) keys.refuse(kTable, key, "is for task preparation, name it");
    *kept = wordsFrom(keys, kTable, key);
  }
  if (!keys.has(kTable, "preset")) return;
  operation.preset = keys.text(kTable, "preset");
  if (const auto known = feelPresets(); std::ranges::find(known, operation.preset) == known.end())
    keys.refuse(kTable, "preset", "there is no such feel, give " + joined(known));
}

void readWarmUp(assets::TomlReader& keys, StudyTemplate& made) {
  if (!keys.has("warm_up")) return;
  made.warm_up_block = keys.text("warm_up", "block", "block-plate");
  if (!assets::practiceTaskOf(made.warm_up_block))
    keys.refuse("warm_up", "block", "there is no such practice block, see molar rehearse --cases");
  made.warm_up_s = keys.number("warm_up", "seconds", {1.0, 1800.0, "s"}, 120.0);
}

}  // namespace

std::optional<std::size_t> StudyTemplate::taskNamed(std::string_view id) const {
  const auto found = std::ranges::find(tasks, id, &TaskTemplate::id);
  return found == tasks.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - tasks.begin()));
}

std::vector<const AskedQuestionnaire*> StudyTemplate::questionnairesFor(std::string_view group) const {
  std::vector<const AskedQuestionnaire*> asked;
  for (const AskedQuestionnaire& one : questionnaires)
    if (one.groups.empty() || std::ranges::find(one.groups, group) != one.groups.end()) asked.push_back(&one);
  return asked;
}

std::vector<std::string> StudyTemplate::tools() const {
  std::vector<std::string> names;
  for (const TaskTemplate& task : tasks)
    if (!task.tool.empty() && std::ranges::find(names, task.tool) == names.end()) names.push_back(task.tool);
  return names;
}

StudyTemplate studyTemplateFrom(std::string_view text, const std::string& where) {
  assets::TomlReader keys(text, where);
  StudyTemplate made;
  made.title = wordsFrom(keys, "", "title");
  made.language = keys.text("", "language");
  refuseUnlessPlain(keys, "", "language", made.language);
  readCase(keys, made);
  made.consent_file = wordsFrom(keys, "", "consent");
  if (made.consent_file.find('/') != std::string::npos || made.consent_file.starts_with("."))
    keys.refuse("", "consent", "give the name of a file beside the template");
  made.order = static_cast<OrderKind>(keys.choice("", "order", {"as-written", "latin-square", "shuffled"}, 0));
  made.seed = static_cast<std::uint64_t>(keys.integer("", "seed", 0, 1'000'000'000, 1));
  made.retention_days = static_cast<int>(keys.integer("", "retention_days", 1, 36'500, made.retention_days));
  made.silence_s = keys.number("", "silence_s", {5.0, 600.0, "s"}, made.silence_s);
  readOperation(keys, made);
  readWarmUp(keys, made);
  if (keys.has("may_change")) {
    made.law_may_change = keys.boolean("may_change", "law", false);
    made.layers_may_change = keys.boolean("may_change", "layers", true);
  }
  std::set<std::string> prompts, tasks, questionnaires;
  if (keys.has("", "prompt"))
    for (std::size_t n = 1, count = keys.tables("prompt", 1, kMostPrompts); n <= count; ++n) {
      const std::string table = "prompt." + std::to_string(n);
      const std::string id = idFrom(keys, table, prompts);
      made.prompts.push_back({id, wordsFrom(keys, table, "say")});
    }
  for (std::size_t n = 1, count = keys.tables("task", 1, kMostTasks); n <= count; ++n)
    made.tasks.push_back(taskFrom(keys, "task." + std::to_string(n), tasks));
  if (keys.has("", "questionnaire"))
    for (std::size_t n = 1, count = keys.tables("questionnaire", 1, kMostQuestionnaires); n <= count; ++n) {
      const std::string table = "questionnaire." + std::to_string(n);
      made.questionnaires.push_back(questionnaireFrom(keys, table));
      if (!questionnaires.insert(made.questionnaires.back().questionnaire.id).second)
        keys.refuse(table, "use", "this questionnaire is asked above, keep one");
    }
  keys.refuseUnknownKeys();
  return made;
}

}  // namespace app
