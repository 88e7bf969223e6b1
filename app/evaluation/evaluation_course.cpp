#include "app/evaluation/evaluation_course.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/evaluation/task_order.h"
#include "app/text/list.h"

namespace app {
namespace {

constexpr std::size_t kLongestWords = 2000, kLongestId = 60;
constexpr std::array<std::string_view, 3> kLights{"green", "amber", "red"};

bool isTooLong(const LogEvent& event) {
  return std::ranges::any_of(event.data, [](const auto& one) {
    const auto* text = std::get_if<std::string>(&one.second);
    return text != nullptr && text->size() > kLongestWords;
  });
}

std::optional<std::string> severityTrouble(const LogEvent& event) {
  const auto severity = event.number("severity");
  if (!severity || (*severity >= 0.0 && *severity <= 4.0 && *severity == std::floor(*severity))) return {};
  return "severity: give a whole number from 0 to 4";
}

}  // namespace

EvaluationCourse::EvaluationCourse(const StudyTemplate& study, const Participant& participant, Sink sink)
    : study_(study), participant_(participant), sink_(std::move(sink)) {
  order_ = taskOrder(study.order, study.tasks.size(), study.seed, numberOfCode(participant.code));
}

void EvaluationCourse::log(const Moment& at, std::string_view source, std::string_view type,
                           std::vector<std::pair<std::string, LogValue>> data) {
  sink_({at.t_ns, at.tick, std::string(source), std::string(type), std::move(data)});
}

bool EvaluationCourse::prepare(const std::vector<Check>& checks, const Moment& at) {
  std::string order;
  for (const std::size_t task : order_) order += (order.empty() ? "" : ", ") + study_.tasks[task].id;
  log(at, "system", "session.start",
      {{"participant", participant_.code},
       {"group", participant_.group},
       {"evaluator", participant_.evaluator},
       {"visit", static_cast<std::int64_t>(participant_.visit)},
       {"seed", static_cast<std::int64_t>(study_.seed)},
       {"order", order}});
  bool is_ready = true;
  for (const Check& check : checks) {
    log(at, "system", "check",
        {{"name", check.name},
         {"light", std::string(kLights[static_cast<std::size_t>(check.light)])},
         {"words", check.words}});
    is_ready = is_ready && check.light != CheckLight::red;
  }
  if (!is_ready) phase_ = Phase::ended;
  return is_ready;
}

void EvaluationCourse::enter(Phase phase, const Moment& at) {
  if (phase <= phase_) return;
  if (phase_ == Phase::tasks) endOfRehearsal(at);
  phase_ = phase;
  log(at, "system", "phase", {{"phase", std::string(kPhases[static_cast<std::size_t>(phase)])}});
}

bool EvaluationCourse::allows(std::string_view stream) const {
  const auto found = consent_.find(stream);
  return found != consent_.end() && found->second;
}

std::optional<bool> EvaluationCourse::wordOn(std::string_view stream) const {
  const auto found = consent_.find(stream);
  return found == consent_.end() ? std::nullopt : std::optional(found->second);
}

const TaskTemplate* EvaluationCourse::running() const {
  return outcomes_.empty() || outcomes_.back().result ? nullptr : &study_.tasks[outcomes_.back().task];
}

const TaskTemplate* EvaluationCourse::startTask(const Moment& at) {
  if (phase_ != Phase::tasks || running() != nullptr || outcomes_.size() == order_.size()) return nullptr;
  TaskOutcome outcome;
  outcome.task = order_[outcomes_.size()];
  outcome.start_tick = at.tick.value_or(0);
  outcomes_.push_back(outcome);
  task_began_ns_ = at.t_ns;
  is_box_over_ = false;
  const TaskTemplate& task = study_.tasks[outcome.task];
  log(at, "system", "task.start",
      {{"task", task.id}, {"place", static_cast<std::int64_t>(outcomes_.size())}, {"tool", task.tool}});
  return &task;
}

void EvaluationCourse::fired(const RuleFired& rule, const Moment& at) {
  const TaskTemplate* const task = running();
  if (task == nullptr) return;
  // Of the tick that made it hold, also where its bone was told later.
  log({at.t_ns, at.tick ? std::optional(rule.told_at) : std::nullopt}, "system", "rule",
      {{"task", task->id},
       {"verdict", std::string(kRuleVerdicts[static_cast<std::size_t>(rule.verdict)])},
       {"rule_tick", static_cast<std::int64_t>(rule.tick)},
       {"time_s", rule.time_s}});
  if (rule.verdict == RuleVerdict::time_box) {
    is_box_over_ = true;
    if (task->at_time_box == AtTimeBox::ask) return;
    const bool partly = task->at_time_box == AtTimeBox::partly;
    outcomes_.back().rule = rule;
    return finishTask(partly ? TaskResult::partly : TaskResult::failed, "rule", "the time was over", at);
  }
  outcomes_.back().rule = rule;
  finishTask(rule.verdict == RuleVerdict::success ? TaskResult::success : TaskResult::failed, "rule", "", at);
}

void EvaluationCourse::endOfRehearsal(const Moment& at) {
  if (running() != nullptr) finishTask(TaskResult::failed, "end", "the rehearsal ended", at);
}

void EvaluationCourse::finishTask(TaskResult result, std::string_view by, const std::string& reason, const Moment& at) {
  // Its pause ends with it.
  if (isPaused()) task_began_ns_ += std::max<std::int64_t>(0, at.t_ns - *std::exchange(paused_ns_, std::nullopt));
  TaskOutcome& outcome = outcomes_.back();
  outcome.result = result, outcome.by = by, outcome.reason = reason;
  constexpr double kSecond_ns = 1e9;
  outcome.time_s =
      by == "rule" && outcome.rule ? outcome.rule->time_s : static_cast<double>(at.t_ns - task_began_ns_) / kSecond_ns;
  log(at, by == "evaluator" ? "evaluator" : "system", "task.stop",
      {{"task", study_.tasks[outcome.task].id},
       {"result", std::string(kTaskResults[static_cast<std::size_t>(result)])},
       {"by", outcome.by},
       {"reason", reason},
       {"time_s", outcome.time_s},
       {"helps", static_cast<std::int64_t>(outcome.helps)}});
}

std::optional<std::string> EvaluationCourse::take(LogEvent event) {
  if (isTooLong(event)) return "a text is longer than " + std::to_string(kLongestWords) + " bytes, shorten it";
  if (event.type == "consent") return takeConsent(event);
  if (event.type == "task") return takeTask(event);
  if (event.type == "answer") return takeAnswer(event);
  if (event.type == "submit") return takeSubmit(event);
  return takeNote(event);
}

std::optional<std::string> EvaluationCourse::takeConsent(const LogEvent& event) {
  const std::string stream = event.textOr("stream");
  const auto given = event.flag("given");
  if (std::ranges::find(kConsentStreams, stream) == kConsentStreams.end())
    return "stream: give one of " + joined(kConsentStreams);
  if (!given) return "given: say true or false";
  if (phase_ < Phase::consent || phase_ >= Phase::close) return "consent is asked for after the checks";
  consent_[stream] = *given;
  sink_(event);
  return {};
}

std::optional<std::string> EvaluationCourse::takeTask(const LogEvent& event) {
  if (phase_ != Phase::tasks) return "there are no tasks now";
  const std::string result = event.textOr("result");
  const auto found = std::ranges::find(kTaskResults, result);
  if (result == "next") {
    const Moment at{event.t_ns, event.tick};
    return startTask(at) != nullptr ? std::nullopt : std::optional<std::string>("a task goes on, or all are done");
  }
  if (result == "pause") return takePause(event);
  if (found == kTaskResults.end()) return "result: give one of " + joined(kTaskResults) + ", next or pause";
  if (outcomes_.empty()) return "no task has begun yet";
  const std::string reason = event.textOr("reason");
  if (reason.empty()) return "reason: say why, it stands beside the rule's own verdict";
  const auto decided = static_cast<TaskResult>(found - kTaskResults.begin());
  if (running() != nullptr)
    finishTask(decided, "evaluator", reason, {event.t_ns, event.tick});
  else {
    // Of the task that ended last: the rule's verdict is kept beside it.
    TaskOutcome& outcome = outcomes_.back();
    outcome.result = decided, outcome.by = "evaluator", outcome.reason = reason;
    log({event.t_ns, event.tick}, "evaluator", "task.override",
        {{"task", study_.tasks[outcome.task].id}, {"result", result}, {"reason", reason}});
  }
  return {};
}

std::optional<std::string> EvaluationCourse::takePause(const LogEvent& event) {
  if (running() == nullptr) return "no task goes on";
  const Moment at{event.t_ns, event.tick};
  if (!isPaused()) {
    paused_ns_ = at.t_ns;
    log(at, "evaluator", "task.pause", {{"task", running()->id}});
    return {};
  }
  constexpr double kSecond_ns = 1e9;
  const std::int64_t paused_ns = std::max<std::int64_t>(0, at.t_ns - *paused_ns_);
  paused_ns_.reset();
  task_began_ns_ += paused_ns;
  log(at, "evaluator", "task.resume",
      {{"task", running()->id}, {"paused_s", static_cast<double>(paused_ns) / kSecond_ns}});
  return {};
}

const AskedQuestionnaire* EvaluationCourse::asked(const LogEvent& event) const {
  for (const AskedQuestionnaire* one : study_.questionnairesFor(participant_.group))
    if (one->questionnaire.id == event.textOr("questionnaire")) return one;
  return nullptr;
}

std::optional<std::string> EvaluationCourse::takeAnswer(const LogEvent& event) {
  const AskedQuestionnaire* const one = asked(event);
  if (one == nullptr) return "questionnaire: this participant is asked no such one";
  const Questionnaire& questionnaire = one->questionnaire;
  if (phase_ != (questionnaire.isOfWords() ? Phase::debrief : Phase::questionnaires))
    return questionnaire.isOfWords() ? "it is asked in the debrief" : "it is asked after the debrief";
  if (locked_.contains(questionnaire.id)) return "it was submitted, answers do not change any more";
  const auto item = std::ranges::find(questionnaire.items, event.textOr("item"), &QuestionItem::id);
  if (item == questionnaire.items.end()) return "item: give one of " + joined(questionnaire.items, &QuestionItem::id);
  LogEvent kept = event;
  if (questionnaire.isOfWords()) {
    // Words of the participant are for who may be quoted.
    if (!allows("quotes")) std::erase_if(kept.data, [](const auto& datum) { return datum.first == "words"; });
  } else if (const auto value = event.number("value")) {
    const int low = questionnaire.lowOf(*item), high = questionnaire.highOf(*item);
    if (!(*value >= low && *value <= high) || *value != std::floor(*value))
      return "value: give a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
             ", or leave it out";
  }
  sink_(kept);
  return {};
}

std::optional<std::string> EvaluationCourse::takeSubmit(const LogEvent& event) {
  const AskedQuestionnaire* const one = asked(event);
  if (one == nullptr) return "questionnaire: this participant is asked no such one";
  if (phase_ != Phase::debrief && phase_ != Phase::questionnaires) return "it was not asked yet";
  if (!locked_.emplace(one->questionnaire.id, true).second) return "it was submitted already";
  sink_(event);
  return {};
}

std::optional<std::string> EvaluationCourse::takeNote(LogEvent& event) {
  if (phase_ < Phase::warm_up || phase_ >= Phase::ended) return "it belongs after the consent";
  if (auto trouble = severityTrouble(event)) return trouble;
  if (event.type == "note") {
    const std::string kind = event.textOr("kind");
    if (kind != "behaviour" && kind != "comment") return "kind: give behaviour or comment";
    // A comment is the participant's own words.
    if (kind == "comment" && !allows("quotes"))
      std::erase_if(event.data, [](const auto& datum) { return datum.first == "text"; });
  } else if (event.type == "prompt") {
    if (std::ranges::find(study_.prompts, event.textOr("prompt"), &PromptTemplate::id) == study_.prompts.end())
      return "prompt: the template has no such prompt";
  } else if (event.type == "help") {
    if (running() == nullptr) return "help is given during a task";
    if (event.textOr("reason").empty()) return "reason: say what the help was";
    ++outcomes_.back().helps;
  } else if (event.type == "problem") {
    const std::string problem = event.textOr("problem");
    if (problem.empty() || problem.size() > kLongestId)
      return "problem: give it a short name, the same in all sessions";
    if (event.textOr("title").empty()) return "title: give a sentence in the user's own terms";
  } else if (event.type != "bookmark" && event.type != "change") {
    return "type: give one of consent, note, prompt, bookmark, help, problem, task, answer, submit";
  }
  if (!outcomes_.empty() && phase_ == Phase::tasks && event.text("task") == nullptr)
    event.data.emplace_back("task", study_.tasks[outcomes_.back().task].id);
  sink_(event);
  return {};
}

}  // namespace app
